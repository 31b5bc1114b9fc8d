#include "animation/shift_scale.h"

#include <cmath>

#include "skeleton/pose.h"

namespace skinforge {

std::vector<double> shift_scales(const Skeleton& skeleton) {
  const auto placed = model_from_joint(skeleton, bind_pose(skeleton));
  Eigen::AlignedBox3d box;
  for (const Affine3& joint : placed) box.extend(Vec3(joint.translation()));
  std::vector<double> scales(skeleton.size(), 0.0);
  const double extent = box.isEmpty() ? 0 : box.diagonal().norm();
  if (extent == 0) return scales;
  for (std::size_t j = 0; j < skeleton.size(); ++j) {
    const JointId parent = skeleton.joints[j].parent;
    const double scale =
        parent.is_valid() ? std::cbrt(std::abs(placed[parent.index()].linear().determinant())) : 1;
    scales[j] = scale / extent;
  }
  return scales;
}

}  // namespace skinforge
