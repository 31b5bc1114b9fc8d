#include "deform/posed_bones.h"

#include <Eigen/LU>
#include <algorithm>

#include "skeleton/rotations.h"

namespace skinforge {

PosedBones posed_bones(const Skeleton& skeleton, std::span<const Transform> pose) {
  PosedBones bones;
  bones.palette = skinning_palette(skeleton, pose);
  for (std::size_t j = 0; j < skeleton.size(); ++j) {
    const Vec3 place = skeleton.joints[j].joint_from_model.inverse().translation();
    double stretch = 0;
    bones.motions.push_back(nearest_motion(bones.palette[j], place, &stretch));
    bones.stretch = std::max(bones.stretch, stretch);
    bones.local.push_back((skeleton.joints[j].bind.rotation.conjugate() * pose[j].rotation).normalized());
  }
  return bones;
}

}  // namespace skinforge
