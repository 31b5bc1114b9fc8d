#include "geometry/self_intersection.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/expect.h"
#include "base/parallel.h"
#include "geometry/box_tree.h"
#include "geometry/triangle_math.h"

namespace skinforge {
namespace {

using Corners = std::array<std::int32_t, 3>;
constexpr double kTolerance =
    1e-9;                     // ours, of the diagonal: above the rounding of the products, below any triangle
constexpr int kLeafSize = 4;  // ours: triangles of a tree's leaf

bool has(const Corners& t, std::int32_t v) {
  return t[0] == v || t[1] == v || t[2] == v;
}

int shared_corners(const Corners& a, const Corners& b) {
  return int(has(b, a[0])) + int(has(b, a[1])) + int(has(b, a[2]));
}

TriangleCorners corners_of(std::span<const Vec3> positions, const Corners& t) {
  return {positions[t[0]], positions[t[1]], positions[t[2]]};
}

Vec3 unit_normal(const TriangleCorners& t) {
  return (t[1] - t[0]).cross(t[2] - t[0]).normalized();
}

bool passes_through(const Vec3& from, const Vec3& to, const TriangleCorners& t, double tolerance) {
  const Vec3 normal = unit_normal(t);
  const double before = normal.dot(from - t[0]), after = normal.dot(to - t[0]);
  if ((before > 0) == (after > 0)) return false;
  if (std::min(std::abs(before), std::abs(after)) <= tolerance) return false;
  const Vec3 point = from + before / (before - after) * (to - from);
  for (int i = 0; i < 3; ++i) {
    const Vec3 side = t[(i + 1) % 3] - t[i];
    if (normal.dot(side.cross(point - t[i])) <= tolerance * side.norm()) return false;
  }
  return true;
}

bool some_edge_passes(std::span<const Vec3> positions, const Corners& a, const Corners& b, double tolerance) {
  const TriangleCorners other = corners_of(positions, b);
  for (int i = 0; i < 3; ++i) {
    const std::int32_t from = a[i], to = a[(i + 1) % 3];
    if (has(b, from) || has(b, to)) continue;
    if (passes_through(positions[from], positions[to], other, tolerance)) return true;
  }
  return false;
}

std::int32_t apex(const Corners& t, const Corners& other) {
  return *std::find_if(t.begin(), t.end(), [&](std::int32_t v) { return !has(other, v); });
}

// One triangle lies on the other, hinged at their common edge.
bool is_folded(std::span<const Vec3> positions, const Corners& a, const Corners& b, double tolerance) {
  const TriangleCorners t = corners_of(positions, a);
  const Vec3 normal = unit_normal(t);
  const std::int32_t mine = apex(a, b), other = apex(b, a);
  const int place = static_cast<int>(std::find(a.begin(), a.end(), mine) - a.begin());
  const Vec3 &from = t[(place + 1) % 3], &to = t[(place + 2) % 3];
  const Vec3 across = positions[other] - from;
  if (std::abs(normal.dot(across)) > tolerance) return false;
  return normal.dot((to - from).cross(across)) > tolerance * (to - from).norm();
}

double tolerance_of(std::span<const Vec3> positions) {
  Box3 box;
  for (const Vec3& p : positions) box.extend(p);
  return box.isEmpty() ? 0 : kTolerance * box.diagonal().norm();
}

bool is_asked(const PairScope& scope, std::size_t triangle) {
  return scope.subset.empty() || scope.subset[triangle] != 0;
}

std::int32_t group_of(const PairScope& scope, std::size_t triangle) {
  return scope.groups.empty() ? -1 : scope.groups[triangle];
}

std::vector<Box3> boxes_of(std::span<const Vec3> positions, std::span<const Corners> triangles) {
  std::vector<Box3> boxes(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (const std::int32_t v : triangles[t]) boxes[t].extend(positions[v]);
  return boxes;
}

// The triangles of one group that are asked about. A tree for each group, so that nobody walks among those it
// is not compared with.
struct Grove {
  std::int32_t group;
  std::vector<std::int32_t> triangles;
  BoxTree tree;
};

std::vector<Grove> groves_of(const std::vector<Box3>& boxes, const PairScope& scope) {
  std::map<std::int32_t, std::vector<std::int32_t>> asked;
  for (std::size_t t = 0; t < boxes.size(); ++t)
    if (is_asked(scope, t)) asked[std::max(group_of(scope, t), -1)].push_back(static_cast<std::int32_t>(t));
  std::vector<Grove> groves;
  for (auto& [group, triangles] : asked) {
    std::vector<Box3> own;
    for (const std::int32_t t : triangles) own.push_back(boxes[static_cast<std::size_t>(t)]);
    groves.push_back({group, std::move(triangles), build_box_tree(own, kLeafSize)});
  }
  return groves;
}

}  // namespace

bool triangles_intersect(std::span<const Vec3> positions, const Corners& a, const Corners& b,
                         double tolerance) {
  if (is_degenerate(corners_of(positions, a)) || is_degenerate(corners_of(positions, b))) return false;
  const int shared = shared_corners(a, b);
  if (shared == 3) return false;
  if (shared == 2) return is_folded(positions, a, b, tolerance);
  return some_edge_passes(positions, a, b, tolerance) || some_edge_passes(positions, b, a, tolerance);
}

std::vector<std::pair<std::int32_t, std::int32_t>> self_intersections(std::span<const Vec3> positions,
                                                                      std::span<const Corners> triangles,
                                                                      const PairScope& scope) {
  SF_EXPECT(scope.subset.empty() || scope.subset.size() == triangles.size());
  SF_EXPECT(scope.groups.empty() || scope.groups.size() == triangles.size());
  const double tolerance = tolerance_of(positions);
  const std::vector<Box3> boxes = boxes_of(positions, triangles);
  const std::vector<Grove> groves = groves_of(boxes, scope);
  std::vector<std::vector<std::int32_t>> partners(triangles.size());
  parallel_chunks(triangles.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto id = static_cast<std::int32_t>(i);
      for (const Grove& grove : groves) {
        if (grove.group >= 0 && grove.group == group_of(scope, i)) continue;
        visit_near(grove.tree, boxes[i], [&](std::int32_t item, std::int32_t) {
          const std::int32_t other = grove.triangles[static_cast<std::size_t>(item)];
          const bool finds_this = is_asked(scope, i) && other <= id;  // the other one finds this pair
          if (finds_this || !boxes[static_cast<std::size_t>(other)].intersects(boxes[i])) return;
          const auto& [first, second] = is_asked(scope, i) ? std::pair(id, other) : std::pair(other, id);
          if (triangles_intersect(positions, triangles[first], triangles[second], tolerance))
            partners[i].push_back(other);
        });
      }
    }
  });
  std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
  for (std::size_t i = 0; i < partners.size(); ++i)
    for (const std::int32_t other : partners[i])
      pairs.emplace_back(std::minmax(static_cast<std::int32_t>(i), other));
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

std::size_t count_self_intersections(std::span<const Vec3> positions, std::span<const Corners> triangles,
                                     const PairScope& scope) {
  return self_intersections(positions, triangles, scope).size();
}

}  // namespace skinforge
