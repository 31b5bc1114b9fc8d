#pragma once

#include <string>
#include <vector>

#include "model/clip.h"
#include "model/skeleton.h"
#include "skeleton/bone_forest.h"
#include "skeleton/rotation_frames.h"

namespace skinforge {

/// Bones as the joints of a character: one joint a bone at its source, with axes along those of the model, so
/// that the relative rotations of ETH Sec. 3 are the local rotations of the joints; a joint at the free end
/// of each last bone; and one joint "root" above where several bones are roots.
struct BoneRig {
  Skeleton skeleton;
  std::vector<JointId> joint_of_bone;
};

/// Joints are called "bone0", ... by the number of their bone from 0, ends "bone7_end".
BoneRig make_bone_rig(const BoneForest& forest);

/// Local rotations of the joints of `rig` whose bones turn by `relative`, one a bone: with respect to the
/// parent, in model axes of the bind pose (ETH Sec. 3). With G the bind rotation from joint to model axes:
/// G_parent^-1 q G. Joints without a bone keep theirs. One a joint.
std::vector<Quat> local_rotations(const BoneRig& rig, std::span<const Quat> relative);

/// The clip that plays frames at `rate_hz`, the first at 0 s: one rotation track a bone.
Clip clip_of_frames(const BoneRig& rig, const RotationFrames& frames, const std::string& name,
                    double rate_hz);

/// The clip from rest to the first of `frames` in `duration` seconds (a *_target file): two keys, which
/// players join along the shorter arc.
Clip clip_to_target(const BoneRig& rig, const RotationFrames& frames, const std::string& name,
                    double duration);

}  // namespace skinforge
