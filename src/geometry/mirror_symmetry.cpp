#include "geometry/mirror_symmetry.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/box_tree.h"
#include "geometry/point_tree.h"

namespace skinforge {
namespace {

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

std::vector<VertexId> partners_between(const PointTree& from, const PointTree& to, const MirrorPlane& plane,
                                       double reach) {
  std::vector<VertexId> partners;
  for (std::size_t v = 0; v < from.points().size(); ++v) {
    VertexId image = to.nearest(plane.mirrored(from.points()[v]), reach);
    if (image.is_valid() && from.nearest(plane.mirrored(to.points()[image.index()]), reach) != VertexId(v))
      image = VertexId();
    partners.push_back(image);
  }
  return partners;
}

constexpr double kKept = 0.98;  // ours: of the partners, as a plane moves to the middle of them

void match(MirrorSymmetry& found, const PointTree& set, double reach) {
  found.partner = partners_between(set, set, found.plane, reach);
  const auto without = std::count(found.partner.begin(), found.partner.end(), VertexId());
  found.matched = 1 - static_cast<double>(without) / static_cast<double>(set.points().size());
}

void offer_planes(MirrorSymmetry& best, const PointTree& set, const Box3& box,
                  const std::array<Vec3, 3>& normals, double reach) {
  for (const Vec3& normal : normals)
    for (const Vec3& through : {Vec3(Vec3::Zero()), Vec3(box.center()), centroid(set.points())}) {
      MirrorSymmetry found{{normal, normal.dot(through)}, {}, 0};
      match(found, set, reach);
      if (found.matched > best.matched) best = std::move(found);
    }
}

// Moves a plane to where the partners say it is, unless that loses some of them.
void settle(MirrorSymmetry& best, const PointTree& set, const Box3& box, double reach) {
  constexpr double kSameOffset = 1e-5;  // ours: of the diagonal; far above the rounding of a file's floats
  std::vector<double> middle;
  for (std::size_t v = 0; v < best.partner.size(); ++v)
    if (best.partner[v].is_valid())
      middle.push_back(best.plane.normal.dot(set.points()[v] + set.points()[best.partner[v].index()]) / 2);
  const auto median = middle.begin() + static_cast<std::ptrdiff_t>(middle.size() / 2);
  std::nth_element(middle.begin(), median, middle.end());
  const bool is_central = std::abs(*median) < kSameOffset * box.diagonal().norm();
  MirrorSymmetry settled{{best.plane.normal, is_central ? 0 : *median}, {}, 0};
  match(settled, set, reach);
  if (settled.matched >= kKept * best.matched) best = std::move(settled);
}

}  // namespace

std::optional<MirrorSymmetry> find_mirror_symmetry(std::span<const Vec3> points,
                                                   const MirrorOptions& options) {
  Box3 box;
  for (const Vec3& p : points) box.extend(p);
  if (points.size() < 2 || !(box.diagonal().norm() > 0)) return std::nullopt;
  const PointTree set(points);
  const double reach = options.tolerance * box.diagonal().norm();
  MirrorSymmetry best;
  offer_planes(best, set, box, {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()}, reach);
  if (best.matched < options.least_share) offer_planes(best, set, box, principal_axes(points), reach);
  if (best.matched < options.least_share) return std::nullopt;
  settle(best, set, box, reach);
  return best;
}

std::vector<VertexId> mirror_partners(std::span<const Vec3> from, std::span<const Vec3> to,
                                      const MirrorPlane& plane, double reach) {
  const PointTree tree(to);
  if (from.data() == to.data() && from.size() == to.size()) return partners_between(tree, tree, plane, reach);
  return partners_between(PointTree(from), tree, plane, reach);
}

}  // namespace skinforge
