#pragma once

#include <span>
#include <vector>

#include "skeleton/pose.h"
#include "skeleton/rigid_motion.h"

namespace skinforge {

/// A pose as the deformers ask for it; one entry a joint.
struct PosedBones {
  std::vector<Affine3> palette;      ///< what linear blending reads (`skinning_palette`)
  std::vector<RigidMotion> motions;  ///< the nearest rigid motions, exact at the joints' bind positions
  std::vector<Quat> local;  ///< rotation relative to the parent, from the bind pose: identity at rest
  double stretch = 0;       ///< largest difference of a scale from 1: what rigid methods leave out
};

/// `pose`: one local transform a joint, as `sample` gives. Linear.
PosedBones posed_bones(const Skeleton& skeleton, std::span<const Transform> pose);

}  // namespace skinforge
