#include "stages/operation_sides.h"

#include "surface/selection.h"

namespace skinforge {

HostSide host_side(const Graft& before, const GraftOperation& operation) {
  HostSide host;
  for (const std::string& name : operation.at) {
    const std::optional<JointId> joint = before.skeleton.find(name);
    if (!joint) continue;  // graft_skeletons says it better
    const JointOrigin& origin = before.origins[joint->index()];
    if (!host.source.is_valid()) host.source = origin.source;
    if (origin.source == host.source) host.joints.push_back(origin.joint);
    host.centre += before.skeleton[*joint].joint_from_model.inverse().translation() /
                   static_cast<double>(operation.at.size());
  }
  return host;
}

std::vector<double> presence_without(const Character& character, std::span<const JointId> joints) {
  std::vector<bool> removed(character.skeleton.size(), false);
  for (const JointId joint : joints) {
    const std::vector<bool> below = character.skeleton.subtree(joint);
    for (std::size_t j = 0; j < removed.size(); ++j) removed[j] = removed[j] || below[j];
  }
  return presence_of_cut(character.mesh, character.weights, removed, {});
}

}  // namespace skinforge
