#include "surface/face_badness.h"

#include <algorithm>
#include <cmath>

#include "geometry/scaled_jacobian.h"

namespace skinforge {
namespace {

// What counts beside the lack of quality (ours): voxels off the surface by more than the gate allows for most
// faces; and what a unit normal and the field's gradient lack to that product, as they do in faces that span
// a thin part, where the field in their middle is flat.
constexpr double kOff = 0.5, kOffWeight = 0.2, kFacing = 0.2, kFacingWeight = 4;

constexpr double kRestWorst = 0.1;  // ours: what all that counts beside it is worth to the worst face

double squared(double x) {
  return x * x;
}

// Of a face by its corners. The worst corner alone has kinks where two are equally bad, and vertices that go
// one after the other stay in them: with all corners beside it they do not.
double lack_of_corners(std::span<const double> corner, double least) {
  double sum = 0;
  for (const double jacobian : corner) sum += squared(1 - jacobian);
  return (squared(1 - least) + sum / static_cast<double>(corner.size())) / 2;
}

}  // namespace

FaceBadness::FaceBadness(FaceGoal goal, double voxel)
    : goal_(goal),
      voxel_(voxel),
      rest_(goal == FaceGoal::Worst ? kRestWorst : 1),
      facing_weight_(std::isfinite(voxel) ? kFacingWeight : 0) {}

double FaceBadness::of(std::span<const Vec3> corners, const SurfaceBeneath& beneath) const {
  Vec3 centre = Vec3::Zero();
  for (const Vec3& p : corners) centre += p;
  centre /= static_cast<double>(corners.size());
  const CornerJacobians jacobians = corner_jacobians(corners);
  const double facing = jacobians.normal.dot(beneath.outward);
  const auto all = std::span(jacobians.corner).first(corners.size());
  const double jacobian = *std::min_element(all.begin(), all.end());
  const double least = facing < 0 ? std::min(jacobian, 0.0) - 1 : jacobian;
  const double distance = beneath.distance + beneath.outward.dot(centre - beneath.centre);
  const double off = std::max(std::abs(distance) / voxel_ - kOff, 0.0),
               away = std::max(kFacing - facing, 0.0);
  const double square = squared(1 - least), cube = (1 - least) * square;
  const double lack = goal_ == FaceGoal::All     ? cube
                      : goal_ == FaceGoal::Worst ? squared(cube)
                                                 : lack_of_corners(all, least);
  return lack + rest_ * kOffWeight * squared(off) + facing_weight_ * squared(away);
}

}  // namespace skinforge
