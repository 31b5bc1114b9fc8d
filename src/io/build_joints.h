#pragma once

#include <string>
#include <vector>

#include "base/issue.h"
#include "io/raw_scene.h"
#include "model/skeleton.h"

namespace skinforge {

/// The joints of a scene with all that the mesh and the clips need to follow them.
struct SceneJoints {
  Skeleton skeleton;
  std::vector<JointId> joint_of_node;   ///< invalid where the node is no joint
  std::vector<Transform> default_pose;  ///< per joint: parent_from_joint as the file's default pose has it
  bool root_is_made = false;            ///< joint 0 is ours: the scene had several roots, or none
  /// Per skin: model_from_mesh in the bind pose.
  std::vector<Affine3> model_from_skin_mesh;
  /// Per skin, per skin joint: the joint that carries its influence (a helper where the skin's own bind pose
  /// differs).
  std::vector<std::vector<JointId>> skin_joint;
};

/// Settles the skeleton: which nodes are joints, one root, unique names, the bind pose (build_character.md,
/// steps 1 to 3).
SceneJoints build_joints(const RawScene& scene, const std::string& place, IssueSink& issues);

/// model_from_joint of the bind pose, metres, one per joint.
std::vector<Affine3> bind_matrices(const SceneJoints& joints);

}  // namespace skinforge
