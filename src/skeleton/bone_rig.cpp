#include "skeleton/bone_rig.h"

#include <fmt/format.h>

#include "base/expect.h"
#include "skeleton/pose.h"

namespace skinforge {
namespace {

JointId add_joint(Skeleton& skeleton, const std::string& name, JointId parent, const Vec3& position) {
  Joint joint;
  joint.name = name;
  joint.parent = parent;
  joint.bind.translation = position;
  if (parent.is_valid()) joint.bind.translation += skeleton[parent].joint_from_model.translation();
  joint.joint_from_model.translation() = -position;
  skeleton.joints.push_back(std::move(joint));
  return JointId(skeleton.size() - 1);
}

// A clip with an empty rotation track for each bone, joints rising.
Clip blank_clip(const BoneRig& rig, const std::string& name, double duration) {
  Clip clip;
  clip.name = name;
  clip.duration = duration;
  std::vector<JointId> joints = rig.joint_of_bone;
  std::sort(joints.begin(), joints.end());
  for (const JointId joint : joints) {
    clip.joints.emplace_back();
    clip.joints.back().joint = joint;
  }
  return clip;
}

void add_key(const BoneRig& rig, Clip& clip, double time, std::span<const Quat> relative) {
  const std::vector<Quat> local = local_rotations(rig, relative);
  for (JointTracks& tracks : clip.joints) {
    tracks.rotation.times.push_back(time);
    tracks.rotation.values.push_back(local[tracks.joint.index()]);
  }
}

}  // namespace

BoneRig make_bone_rig(const BoneForest& forest) {
  BoneRig rig;
  rig.joint_of_bone.resize(forest.size());
  JointId root;
  if (forest.roots.size() > 1)
    root = add_joint(rig.skeleton, "root", JointId(),
                     forest.source[static_cast<std::size_t>(forest.roots.front())]);
  std::vector<bool> is_last(forest.size(), true);
  for (const std::int32_t bone : forest.order) {
    const auto k = static_cast<std::size_t>(bone);
    const std::int32_t parent = forest.parent[k];
    if (parent >= 0) is_last[static_cast<std::size_t>(parent)] = false;
    const JointId above = parent < 0 ? root : rig.joint_of_bone[static_cast<std::size_t>(parent)];
    rig.joint_of_bone[k] = add_joint(rig.skeleton, fmt::format("bone{}", k), above, forest.source[k]);
  }
  for (std::size_t k = 0; k < forest.size(); ++k)
    if (is_last[k])
      add_joint(rig.skeleton, fmt::format("bone{}_end", k), rig.joint_of_bone[k], forest.end[k]);
  return rig;
}

std::vector<Quat> local_rotations(const BoneRig& rig, std::span<const Quat> relative) {
  SF_EXPECT(relative.size() == rig.joint_of_bone.size());
  const Pose bind = bind_pose(rig.skeleton);
  const std::vector<Quat> model_from_joint = global_rotations(rig.skeleton, bind);
  std::vector<Quat> local;
  for (const Transform& joint : bind) local.push_back(joint.rotation);
  for (std::size_t k = 0; k < relative.size(); ++k) {
    const JointId joint = rig.joint_of_bone[k], parent = rig.skeleton[joint].parent;
    const Quat above = parent.is_valid() ? model_from_joint[parent.index()] : Quat::Identity();
    local[joint.index()] = above.conjugate() * relative[k] * model_from_joint[joint.index()];
  }
  return local;
}

Clip clip_of_frames(const BoneRig& rig, const RotationFrames& frames, const std::string& name,
                    double rate_hz) {
  SF_EXPECT(!frames.frames.empty() && rate_hz > 0);
  Clip clip = blank_clip(rig, name, static_cast<double>(frames.frames.size() - 1) / rate_hz);
  for (std::size_t f = 0; f < frames.frames.size(); ++f)
    add_key(rig, clip, static_cast<double>(f) / rate_hz, frames.frames[f]);
  return clip;
}

Clip clip_to_target(const BoneRig& rig, const RotationFrames& frames, const std::string& name,
                    double duration) {
  SF_EXPECT(!frames.frames.empty() && duration > 0);
  Clip clip = blank_clip(rig, name, duration);
  const std::vector<Quat>& target = frames.frames.front();
  add_key(rig, clip, 0, pose_towards(target, 0));
  add_key(rig, clip, duration, pose_towards(target, 1));
  return clip;
}

}  // namespace skinforge
