#include "geometry/mirror_symmetry.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>

#include "geometry/box_tree.h"
#include "geometry/triangle_bvh.h"

namespace skinforge {
namespace {

// Nearest point of a set, by a hierarchy of triangles that are points.
class PointSet {
 public:
  explicit PointSet(std::span<const Vec3> points) : points_(points), bvh_(points, triangles(points.size())) {}

  VertexId nearest(const Vec3& p, double limit) const { return VertexId(bvh_.closest(p, limit).triangle); }
  std::span<const Vec3> points() const { return points_; }

 private:
  static std::vector<std::array<std::int32_t, 3>> triangles(std::size_t count) {
    std::vector<std::array<std::int32_t, 3>> result;
    for (std::size_t i = 0; i < count; ++i) {
      const auto v = static_cast<std::int32_t>(i);
      result.push_back({v, v, v});
    }
    return result;
  }

  std::span<const Vec3> points_;
  TriangleBvh bvh_;
};

Vec3 centroid(std::span<const Vec3> points) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

std::array<Vec3, 3> principal_axes(std::span<const Vec3> points) {
  const Vec3 centre = centroid(points);
  Mat3 covariance = Mat3::Zero();
  for (const Vec3& p : points) covariance += (p - centre) * (p - centre).transpose();
  const Mat3 axes = Eigen::SelfAdjointEigenSolver<Mat3>(covariance).eigenvectors();
  return {axes.col(0), axes.col(1), axes.col(2)};
}

void match(MirrorSymmetry& plane, const PointSet& set, double reach) {
  const auto points = set.points();
  std::vector<VertexId> image(points.size());
  for (std::size_t v = 0; v < points.size(); ++v) image[v] = set.nearest(plane.mirrored(points[v]), reach);
  plane.partner.assign(points.size(), VertexId());
  std::size_t matched = 0;
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (!image[v].is_valid() || image[image[v].index()] != VertexId(v)) continue;
    plane.partner[v] = image[v];
    ++matched;
  }
  plane.matched = static_cast<double>(matched) / static_cast<double>(points.size());
}

void offer_planes(MirrorSymmetry& best, const PointSet& set, const Box3& box,
                  const std::array<Vec3, 3>& normals, double reach) {
  for (const Vec3& normal : normals)
    for (const Vec3& through : {Vec3(Vec3::Zero()), Vec3(box.center()), centroid(set.points())}) {
      MirrorSymmetry plane{normal, normal.dot(through), {}, 0};
      match(plane, set, reach);
      if (plane.matched > best.matched) best = std::move(plane);
    }
}

}  // namespace

std::optional<MirrorSymmetry> find_mirror_symmetry(std::span<const Vec3> points,
                                                   const MirrorOptions& options) {
  Box3 box;
  for (const Vec3& p : points) box.extend(p);
  if (points.size() < 2 || !(box.diagonal().norm() > 0)) return std::nullopt;
  const PointSet set(points);
  const double reach = options.tolerance * box.diagonal().norm();
  MirrorSymmetry best;
  offer_planes(best, set, box, {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()}, reach);
  if (best.matched < options.least_share) offer_planes(best, set, box, principal_axes(points), reach);
  if (best.matched < options.least_share) return std::nullopt;
  return best;
}

}  // namespace skinforge
