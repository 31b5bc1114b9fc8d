#include "geometry/point_tree.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <tuple>

namespace skinforge {
namespace {

constexpr std::size_t kLeafSize = 8;  // ours: fewer are looked at one by one

}  // namespace

PointTree::PointTree(std::span<const Vec3> points) : points_(points), axis_(points.size(), 0) {
  order_.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) order_.push_back(VertexId(i));
  build(0, points.size());
}

void PointTree::build(std::size_t begin, std::size_t end) {
  if (end - begin <= kLeafSize) return;
  Eigen::AlignedBox3d box;
  for (std::size_t i = begin; i < end; ++i) box.extend(points_[order_[i].index()]);
  Eigen::Index axis = 0;
  box.sizes().maxCoeff(&axis);
  const std::size_t middle = begin + (end - begin) / 2;
  const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(middle), at(end), [&](VertexId a, VertexId b) {
    return std::tuple(points_[a.index()][axis], a) < std::tuple(points_[b.index()][axis], b);
  });
  axis_[middle] = static_cast<unsigned char>(axis);
  build(begin, middle);
  build(middle + 1, end);
}

VertexId PointTree::nearest(const Vec3& p, double limit) const {
  Best best{limit * limit, VertexId()};
  search(0, points_.size(), p, best);
  return best.point;
}

void PointTree::search(std::size_t begin, std::size_t end, const Vec3& p, Best& best) const {
  const auto look = [&](VertexId v) {
    const double distance2 = (p - points_[v.index()]).squaredNorm();
    const bool is_lower = !best.point.is_valid() || v < best.point;
    if (distance2 < best.distance2 || (distance2 == best.distance2 && is_lower)) best = {distance2, v};
  };
  if (end - begin <= kLeafSize) {
    for (std::size_t i = begin; i < end; ++i) look(order_[i]);
    return;
  }
  const std::size_t middle = begin + (end - begin) / 2;
  const double beyond = p[axis_[middle]] - points_[order_[middle].index()][axis_[middle]];
  look(order_[middle]);
  if (beyond < 0)
    search(begin, middle, p, best);
  else
    search(middle + 1, end, p, best);
  if (beyond * beyond > best.distance2) return;
  if (beyond < 0)
    search(middle + 1, end, p, best);
  else
    search(begin, middle, p, best);
}

}  // namespace skinforge
