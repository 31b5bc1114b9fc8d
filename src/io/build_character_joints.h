#pragma once

#include <string>
#include <vector>

#include "base/issue.h"
#include "io/build_character_bind.h"
#include "model/skeleton.h"

namespace skinforge {

/// The skeleton of a scene, and how it hangs together with the scene's nodes.
struct JointTable {
  Skeleton skeleton;
  std::vector<Transform> rest;           ///< per joint, the file's default pose; metres at the top
  std::vector<JointId> joint_of_node;    ///< invalid: the node is no joint
  std::vector<bool> is_top;              ///< per joint: a root of the file, which takes `metres_from_file`
  std::vector<JointId> carrier_of_node;  ///< per node, the nearest joint at or above it, else the root
};

/// The joints of a bound scene: `build_character.md`, step 3. Parents first, names unique, one root.
JointTable build_joints(const RawScene& scene, const BoundScene& bound, const std::string& place,
                        IssueSink& issues);

}  // namespace skinforge
