#include "skeleton/pose.h"

#include "base/expect.h"

namespace skinforge {

Pose bind_pose(const Skeleton& skeleton) {
  Pose pose;
  pose.reserve(skeleton.size());
  for (const Joint& joint : skeleton.joints) pose.push_back(joint.bind);
  return pose;
}

std::vector<Affine3> model_from_joint(const Skeleton& skeleton, std::span<const Transform> pose) {
  SF_EXPECT(pose.size() == skeleton.size());
  std::vector<Affine3> all(skeleton.size());
  for (std::size_t j = 0; j < skeleton.size(); ++j) {
    const JointId parent = skeleton.joints[j].parent;
    all[j] = parent.is_valid() ? Affine3(all[parent.index()] * pose[j].matrix()) : pose[j].matrix();
  }
  return all;
}

Affine3 model_from_joint(const Skeleton& skeleton, std::span<const Transform> pose, JointId joint) {
  SF_EXPECT(pose.size() == skeleton.size());
  Affine3 placed = pose[joint.index()].matrix();
  for (JointId j = skeleton[joint].parent; j.is_valid(); j = skeleton[j].parent)
    placed = pose[j.index()].matrix() * placed;
  return placed;
}

std::vector<Quat> global_rotations(const Skeleton& skeleton, std::span<const Transform> pose) {
  SF_EXPECT(pose.size() == skeleton.size());
  std::vector<Quat> all(skeleton.size());
  for (std::size_t j = 0; j < skeleton.size(); ++j) {
    const JointId parent = skeleton.joints[j].parent;
    all[j] = parent.is_valid() ? all[parent.index()] * pose[j].rotation : pose[j].rotation;
  }
  return all;
}

std::vector<Affine3> skinning_palette(const Skeleton& skeleton, std::span<const Transform> pose) {
  std::vector<Affine3> palette = model_from_joint(skeleton, pose);
  for (std::size_t j = 0; j < palette.size(); ++j)
    palette[j] = palette[j] * skeleton.joints[j].joint_from_model;
  return palette;
}

std::vector<Vec3> spread_translations(const Skeleton& skeleton,
                                      std::span<const std::pair<JointId, Vec3>> given) {
  const std::size_t n = skeleton.size();
  std::vector<Vec3> value(n, Vec3::Zero());
  if (given.empty()) return value;
  std::vector<bool> fixed(n, false);
  for (const auto& [joint, translation] : given) {
    SF_EXPECT(joint.is_valid() && joint.index() < n);
    fixed[joint.index()] = true;
    value[joint.index()] = translation;
  }
  // Row of a free joint: degree * x - sum of the neighbours' x = 0. A tree is eliminated from its leaves to
  // its root without fill; what is left of a row reads diagonal * x_joint - x_parent = value.
  std::vector<double> diagonal(n, 0.0);
  for (std::size_t j = 1; j < n; ++j) {
    ++diagonal[j];
    ++diagonal[skeleton.joints[j].parent.index()];
  }
  for (std::size_t j = n; j-- > 1;) {
    const std::size_t parent = skeleton.joints[j].parent.index();
    if (fixed[parent]) continue;
    if (!fixed[j]) diagonal[parent] -= 1 / diagonal[j];
    value[parent] += fixed[j] ? value[j] : Vec3(value[j] / diagonal[j]);
  }
  for (std::size_t j = 0; j < n; ++j) {
    if (fixed[j]) continue;
    if (j > 0) value[j] += value[skeleton.joints[j].parent.index()];
    value[j] /= diagonal[j];
  }
  return value;
}

}  // namespace skinforge
