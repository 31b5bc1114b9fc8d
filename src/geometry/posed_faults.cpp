#include "geometry/posed_faults.h"

#include <algorithm>
#include <map>

#include "base/expect.h"
#include "geometry/box_tree.h"
#include "geometry/self_intersection.h"

namespace skinforge {
namespace {

constexpr double kFoldedCosine = -0.94;  // ours: of the angle between normals, 160 degrees
constexpr double kShortEdge = 1e-3;      // ours: of the mean; the stretch of shorter ones says nothing

Vec3 normal_of(std::span<const Vec3> positions, const TriangleCornerIds& t) {
  return (positions[t[1]] - positions[t[0]]).cross(positions[t[2]] - positions[t[0]]).normalized();
}

Box3 box_of(std::span<const Vec3> positions, const TriangleCornerIds& t) {
  Box3 box;
  for (const std::int32_t v : t) box.extend(positions[v]);
  return box;
}

// Flags of the triangles that are not of the part with most of them: each pair in question has one such.
std::vector<std::uint8_t> all_but_the_largest(std::span<const std::int32_t> parts) {
  std::map<std::int32_t, std::size_t> counts;
  for (const std::int32_t part : parts)
    if (part >= 0) ++counts[part];
  const auto largest = std::max_element(counts.begin(), counts.end(),
                                        [](const auto& a, const auto& b) { return a.second < b.second; });
  std::vector<std::uint8_t> flags;
  for (const std::int32_t part : parts) flags.push_back(counts.empty() || part != largest->first);
  return flags;
}

// Boxes round the triangles of each part.
std::map<std::int32_t, Box3> part_boxes(std::span<const Vec3> positions,
                                        std::span<const TriangleCornerIds> triangles,
                                        std::span<const std::int32_t> parts) {
  std::map<std::int32_t, Box3> boxes;
  for (std::size_t t = 0; t < triangles.size(); ++t) boxes[parts[t]].extend(box_of(positions, triangles[t]));
  return boxes;
}

}  // namespace

PosedSurface::PosedSurface(std::span<const Vec3> rest, std::span<const TriangleCornerIds> triangles,
                           std::span<const std::int32_t> parts)
    : triangles_(triangles), parts_(parts) {
  SF_EXPECT(parts.size() == triangles.size());
  std::vector<bool> is_new(rest.size(), false);  // vertices of new surface
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (const std::int32_t v : triangles[t])
      if (parts[t] < 0) is_new[static_cast<std::size_t>(v)] = true;
  std::map<std::array<std::int32_t, 2>, std::vector<std::int32_t>> sides;
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (int i = 0; i < 3; ++i) {
      const std::int32_t a = triangles[t][i], b = triangles[t][(i + 1) % 3];
      if (!is_new[static_cast<std::size_t>(a)] || !is_new[static_cast<std::size_t>(b)]) continue;
      sides[{std::min(a, b), std::max(a, b)}].push_back(static_cast<std::int32_t>(t));
    }
  double sum = 0;
  for (const auto& [edge, around] : sides) {
    if (std::none_of(around.begin(), around.end(), [&](std::int32_t t) { return parts_[t] < 0; })) continue;
    edges_.push_back({edge, (rest[edge[0]] - rest[edge[1]]).norm()});
    sum += edges_.back().second;
    if (around.size() != 2) continue;
    const Pair pair{around[0], around[1]};
    if (!folds(rest, pair)) neighbours_.push_back(pair);
  }
  const double shortest = edges_.empty() ? 0 : kShortEdge * sum / static_cast<double>(edges_.size());
  std::erase_if(edges_, [&](const auto& edge) { return edge.second <= shortest; });
  rest_cuts_ = cuts(rest);
}

bool PosedSurface::folds(std::span<const Vec3> positions, const Pair& neighbours) const {
  return normal_of(positions, triangles_[neighbours.first])
             .dot(normal_of(positions, triangles_[neighbours.second])) < kFoldedCosine;
}

// Pairs of different parts, or with a new triangle, that cut each other.
std::vector<PosedSurface::Pair> PosedSurface::cuts(std::span<const Vec3> positions) const {
  const auto boxes = part_boxes(positions, triangles_, parts_);
  std::vector<std::int32_t> near;
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    const Box3 box = box_of(positions, triangles_[t]);
    const bool meets = parts_[t] < 0 || std::any_of(boxes.begin(), boxes.end(), [&](const auto& part) {
                         return part.first != parts_[t] && part.second.intersects(box);
                       });
    if (meets) near.push_back(static_cast<std::int32_t>(t));
  }
  std::vector<TriangleCornerIds> triangles;
  std::vector<std::int32_t> parts;
  for (const std::int32_t t : near) triangles.push_back(triangles_[t]), parts.push_back(parts_[t]);
  std::vector<Pair> found;
  for (const auto& [a, b] : self_intersections(positions, triangles, {all_but_the_largest(parts), parts}))
    found.emplace_back(near[a], near[b]);
  return found;
}

PosedFaults PosedSurface::measure(std::span<const Vec3> positions) const {
  PosedFaults faults;
  const auto blame = [&](const Pair& pair) {
    faults.triangles.insert(faults.triangles.end(), {pair.first, pair.second});
  };
  for (const Pair& pair : neighbours_)
    if (folds(positions, pair)) {
      ++faults.folds;
      blame(pair);
    }
  for (const auto& [edge, length] : edges_)
    faults.stretch = std::max(faults.stretch, (positions[edge[0]] - positions[edge[1]]).norm() / length);
  for (const Pair& pair : cuts(positions)) {
    if (std::binary_search(rest_cuts_.begin(), rest_cuts_.end(), pair)) continue;
    ++faults.intersections;
    blame(pair);
  }
  std::sort(faults.triangles.begin(), faults.triangles.end());
  faults.triangles.erase(std::unique(faults.triangles.begin(), faults.triangles.end()),
                         faults.triangles.end());
  return faults;
}

}  // namespace skinforge
