#include "model/skeleton.h"

namespace skinforge {

std::optional<JointId> Skeleton::find(std::string_view name) const {
  for (std::size_t j = 0; j < joints.size(); ++j)
    if (joints[j].name == name) return JointId(j);
  return std::nullopt;
}

std::vector<std::string> Skeleton::names() const {
  std::vector<std::string> all;
  all.reserve(joints.size());
  for (const Joint& joint : joints) all.push_back(joint.name);
  return all;
}

std::vector<std::vector<JointId>> Skeleton::children() const {
  std::vector<std::vector<JointId>> all(joints.size());
  for (std::size_t j = 0; j < joints.size(); ++j)
    if (joints[j].parent.is_valid()) all[joints[j].parent.index()].push_back(JointId(j));
  return all;
}

std::vector<bool> Skeleton::subtree(JointId top) const {
  std::vector<bool> inside(joints.size(), false);
  for (std::size_t j = top.index(); j < joints.size(); ++j) {
    const JointId parent = joints[j].parent;
    inside[j] = j == top.index() || (parent.is_valid() && inside[parent.index()]);
  }
  return inside;
}

std::vector<Affine3> Skeleton::model_from_joint() const {
  std::vector<Affine3> all;
  all.reserve(joints.size());
  for (const Joint& joint : joints) all.push_back(joint.joint_from_model.inverse());
  return all;
}

}  // namespace skinforge
