#include "geometry/triangle_bvh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/expect.h"
#include "geometry/box_tree.h"
#include "geometry/triangle_math.h"
#include "geometry/winding_expansion.h"

namespace skinforge {
namespace {

constexpr int kLeafSize = 4;      // ours: 2, 4 and 8 measured, see triangle_bvh.md
constexpr double kSlack = 1e-12;  // ours: relative, some roundings of a triangle inequality
constexpr double kHuge = std::numeric_limits<double>::max();

Box3 box_of(const TriangleCorners& t) {
  Box3 box(t[0]);
  box.extend(t[1]);
  box.extend(t[2]);
  return box;
}

// A disc around a triangle, in its plane: most triangles of a leaf are farther than the best so far, and this
// shows it cheaply. A degenerate triangle has normal zero, which makes it a ball.
struct Disc {
  Vec3 centre, normal;
  double radius = 0;

  explicit Disc(const TriangleCorners& t) : centre((t[0] + t[1] + t[2]) / 3), normal(Vec3::Zero()) {
    if (!is_degenerate(t)) normal = (t[1] - t[0]).cross(t[2] - t[0]).normalized();
    for (const Vec3& corner : t) radius = std::max(radius, (corner - centre).norm());
  }
  // Whether every point of the disc is farther from p than the root of distance2.
  bool is_beyond(const Vec3& p, double distance2) const {
    const Vec3 away = p - centre;
    const double away2 = away.squaredNorm(), height = normal.dot(away), height2 = height * height;
    const double rounding = kSlack * (away2 + distance2);
    const double left2 =
        distance2 - height2 + rounding;  // what the height leaves for the way along the plane
    if (left2 < 0) return true;
    const double reach = radius + std::sqrt(left2);
    return away2 - height2 - rounding > reach * reach;
  }
};

// A child to visit and the distance at which it begins.
struct Visit {
  double at = 0;
  int lane = 0;
};

// The present children that begin no farther than `limit`, nearest first.
struct VisitList {
  std::array<Visit, BoxTree::kWidth> visits;
  int count = 0;

  VisitList(const BoxTree::Node& node, const BoxTree::Lanes& at, double limit) {
    for (int lane = 0; lane < BoxTree::kWidth; ++lane) {
      if (!(at[lane] <= limit) || node.children[lane].is_none()) continue;
      int place = count++;
      for (; place > 0 && visits[place - 1].at > at[lane]; --place) visits[place] = visits[place - 1];
      visits[place] = {at[lane], lane};
    }
  }
};

// Nodes still to visit; the depth of the tree bounds it.
class NodeStack {
 public:
  struct Entry {
    double at;
    std::int32_t node;
  };
  void push(double at, std::int32_t node) { entries_[count_++] = {at, node}; }
  Entry pop() { return entries_[--count_]; }
  bool is_empty() const { return count_ == 0; }

 private:
  std::array<Entry, BoxTree::kStackSize> entries_;
  int count_ = 0;
};

struct Ray {
  Vec3 origin, direction, inverse;

  Ray(const Vec3& o, const Vec3& d) : origin(o), direction(d) {
    constexpr double kSteep = 1e200;  // for a zero component: larger than any quotient, still finite times 0
    for (int axis = 0; axis < 3; ++axis)
      inverse[axis] = std::abs(d[axis]) > 1 / kSteep ? 1 / d[axis] : std::copysign(kSteep, d[axis]);
  }
};

// Where the ray enters each child's box; huge where it misses.
BoxTree::Lanes entries(const BoxTree::Node& node, const Ray& ray) {
  constexpr double kLonger = 1 + 8 * std::numeric_limits<double>::epsilon();  // roundings of the two products
  BoxTree::Lanes enter = BoxTree::Lanes::Zero(), leave = BoxTree::Lanes::Constant(kHuge);
  for (int axis = 0; axis < 3; ++axis) {
    const BoxTree::Lanes a = (node.low[axis] - ray.origin[axis]) * ray.inverse[axis];
    const BoxTree::Lanes b = (node.high[axis] - ray.origin[axis]) * ray.inverse[axis];
    enter = enter.max(a.min(b));
    leave = leave.min(a.max(b));
  }
  return (enter <= leave * kLonger).select(enter, std::numeric_limits<double>::infinity());
}

}  // namespace

struct TriangleBvh::Impl {
  BoxTree tree;
  std::vector<TriangleCorners> corners;      // in the order of the tree's leaves
  std::vector<Disc> discs;                   // likewise
  std::vector<std::int32_t> place_of;        // of each triangle given, in that order
  std::vector<std::uint8_t> degenerate;      // likewise: 1 for a triangle without a plane
  std::vector<WindingExpansion> expansions;  // one per node

  Impl(std::span<const Vec3> positions, std::span<const std::array<std::int32_t, 3>> triangles) {
    std::vector<TriangleCorners> given;
    given.reserve(triangles.size());
    for (const auto& t : triangles) {
      for (const std::int32_t v : t) SF_EXPECT(v >= 0 && static_cast<std::size_t>(v) < positions.size());
      given.push_back({positions[t[0]], positions[t[1]], positions[t[2]]});
    }
    std::vector<Box3> boxes;
    boxes.reserve(given.size());
    for (const TriangleCorners& t : given) boxes.push_back(box_of(t));
    tree = build_box_tree(boxes, kLeafSize);
    corners.reserve(given.size());
    for (const std::int32_t i : tree.order) corners.push_back(given[i]);
    place_of.resize(given.size());
    for (std::size_t place = 0; place < given.size(); ++place)
      place_of[tree.order[place]] = static_cast<std::int32_t>(place);
    for (const TriangleCorners& t : corners) discs.emplace_back(t);
    for (const TriangleCorners& t : corners) degenerate.push_back(is_degenerate(t) ? 1 : 0);
    expand();
  }

  Vec3 closest_barycentric(std::int32_t place, const Vec3& query) const {
    return degenerate[place] ? skinforge::closest_barycentric(query, corners[place])
                             : closest_barycentric_in_plane(query, corners[place]);
  }

  // Moments of every cluster from the leaves up; children stand behind their parents.
  void expand() {
    std::vector<WindingMoments> moments(tree.nodes.size());
    expansions.resize(tree.nodes.size());
    for (std::size_t n = tree.nodes.size(); n-- > 0;) {
      std::vector<WindingMoments> parts;
      for (int lane = 0; lane < BoxTree::kWidth; ++lane) {
        const BoxTree::Child child = tree.nodes[n].children[lane];
        if (child.is_none()) continue;
        parts.push_back(child.is_leaf() ? leaf_moments(child) : moments[child.first]);
        expansions[n].set(lane, parts.back(), radius(child, parts.back().centre));
      }
      moments[n] = WindingMoments::sum(parts);
    }
  }

  WindingMoments leaf_moments(BoxTree::Child leaf) const {
    std::vector<WindingMoments> parts;
    for (std::int32_t i = leaf.first; i < leaf.first + leaf.count; ++i)
      parts.push_back(WindingMoments::of(corners[i]));
    return WindingMoments::sum(parts);
  }

  double radius(BoxTree::Child child, const Vec3& centre) const {
    const std::int32_t begin = child.is_leaf() ? child.first : tree.nodes[child.first].begin;
    const std::int32_t end = child.is_leaf() ? child.first + child.count : tree.nodes[child.first].end;
    double largest2 = 0;
    for (std::int32_t i = begin; i < end; ++i)
      for (const Vec3& corner : corners[i]) largest2 = std::max(largest2, (corner - centre).squaredNorm());
    return std::sqrt(largest2);
  }

  // Depth-first walk, nearest child first. `children_at(node)`: where each child begins; `visit_leaf(child,
  // limit)` looks at the leaf's triangles and returns the new limit; children that begin beyond the limit are
  // passed over.
  template <class ChildrenAt, class VisitLeaf>
  void nearest_first(double limit, const ChildrenAt& children_at, const VisitLeaf& visit_leaf) const {
    if (tree.nodes.empty()) return;
    NodeStack stack;
    stack.push(0, 0);
    while (!stack.is_empty()) {
      const auto [at, id] = stack.pop();
      if (at > limit) continue;
      const BoxTree::Node& node = tree.nodes[id];
      const VisitList list(node, children_at(node), limit);
      for (int i = 0; i < list.count; ++i) {
        const BoxTree::Child child = node.children[list.visits[i].lane];
        if (child.is_leaf() && list.visits[i].at <= limit) limit = visit_leaf(child, limit);
      }
      for (int i = list.count; i-- > 0;) {
        const BoxTree::Child child = node.children[list.visits[i].lane];
        if (!child.is_leaf()) stack.push(list.visits[i].at, child.first);
      }
    }
  }

  double exact_solid_angle(BoxTree::Child leaf, const Vec3& query) const {
    const std::span<const TriangleCorners> all(corners.data() + leaf.first,
                                               static_cast<std::size_t>(leaf.count));
    const auto flags = degenerate.begin() + leaf.first;
    if (std::none_of(flags, flags + leaf.count, [](std::uint8_t flag) { return flag != 0; }))
      return solid_angle(query, all);
    double sum = 0;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (!flags[static_cast<std::ptrdiff_t>(i)]) sum += solid_angle(query, all.subspan(i, 1));
    return sum;
  }

  // The nearest of `best` so far and all triangles no farther than sqrt(limit2).
  ClosestPoint closest(const Vec3& query, double limit2, ClosestPoint best) const {
    const auto visit_leaf = [&](BoxTree::Child leaf, double least2) {
      for (std::int32_t i = leaf.first; i < leaf.first + leaf.count; ++i)
        if (!discs[i].is_beyond(query, least2)) least2 = improve(best, query, i, least2);
      return least2;
    };
    nearest_first(
        limit2, [&](const BoxTree::Node& node) { return BoxTree::distances2(node, query); }, visit_leaf);
    if (best.triangle >= 0) best.distance = (query - best.point).norm();
    return best;
  }

  // Takes the triangle at `place` if it is nearer, or as near and of lower index; returns the new least
  // distance squared.
  double improve(ClosestPoint& best, const Vec3& query, std::int32_t place, double least2) const {
    const std::int32_t triangle = tree.order[place];
    const Vec3 barycentric = closest_barycentric(place, query);
    const Vec3 point = interpolate(corners[place], barycentric);
    const double distance2 = (query - point).squaredNorm();
    const bool is_lower = best.triangle < 0 || triangle < best.triangle;
    if (distance2 > least2 || (distance2 == least2 && !is_lower)) return least2;
    best.triangle = triangle;
    best.barycentric = barycentric;
    best.point = point;
    return distance2;
  }
};

TriangleBvh::TriangleBvh(std::span<const Vec3> positions,
                         std::span<const std::array<std::int32_t, 3>> triangles)
    : impl_(std::make_unique<Impl>(positions, triangles)) {}
TriangleBvh::~TriangleBvh() = default;
TriangleBvh::TriangleBvh(TriangleBvh&&) noexcept = default;
TriangleBvh& TriangleBvh::operator=(TriangleBvh&&) noexcept = default;

ClosestPoint TriangleBvh::closest(const Vec3& query, double limit) const {
  return impl_->closest(query, std::min(limit * limit, kHuge), {});
}

ClosestPoint TriangleBvh::closest_from_hint(const Vec3& query, std::int32_t hint) const {
  ClosestPoint best;
  const double limit2 = impl_->improve(best, query, impl_->place_of[hint], kHuge);
  return impl_->closest(query, limit2, best);
}

double TriangleBvh::winding_number(const Vec3& query) const {
  if (impl_->tree.nodes.empty()) return 0;
  double sum = 0;
  NodeStack stack;
  stack.push(0, 0);
  while (!stack.is_empty()) {
    const std::int32_t id = stack.pop().node;
    const BoxTree::Node& node = impl_->tree.nodes[id];
    const WindingExpansion& expansion = impl_->expansions[id];
    const auto [far_field, distance2] = expansion.at(query);
    for (int lane = 0; lane < BoxTree::kWidth; ++lane) {
      const BoxTree::Child child = node.children[lane];
      if (child.is_none()) continue;
      if (distance2[lane] > expansion.far2[lane])
        sum += far_field[lane];
      else if (child.is_leaf())
        sum += impl_->exact_solid_angle(child, query);
      else
        stack.push(0, child.first);
    }
  }
  return sum / (4 * std::numbers::pi);
}

RayHit TriangleBvh::first_hit(const Vec3& origin, const Vec3& direction, double limit) const {
  RayHit best;
  const Ray ray(origin, direction);
  const auto visit_leaf = [&](BoxTree::Child leaf, double farthest) {
    for (std::int32_t i = leaf.first; i < leaf.first + leaf.count; ++i) {
      const std::int32_t triangle = impl_->tree.order[i];
      const auto t = ray_parameter(origin, direction, impl_->corners[i]);
      if (!t || *t <= 0 || *t >= limit) continue;
      if (*t > farthest || (*t == farthest && triangle > best.triangle)) continue;
      farthest = *t;
      best = {triangle, *t};
    }
    return farthest;
  };
  impl_->nearest_first(
      limit, [&](const BoxTree::Node& node) { return entries(node, ray); }, visit_leaf);
  return best;
}

std::vector<std::int32_t> TriangleBvh::overlapping(const Vec3& low, const Vec3& high) const {
  std::vector<std::int32_t> found;
  const Box3 wanted(low, high);
  visit_near(impl_->tree, wanted, [&](std::int32_t triangle, std::int32_t place) {
    if (box_of(impl_->corners[place]).intersects(wanted)) found.push_back(triangle);
  });
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace skinforge
