#pragma once

#include <string>
#include <vector>

#include "base/issue.h"
#include "io/build_joints.h"
#include "model/clip.h"

namespace skinforge {

/// The clips of a scene on its joints (build_character.md, step 5): every key as the file has it; where a
/// clip leaves a property alone and the file's default pose differs from the bind pose, one constant key
/// holds the default, so that the clip plays as in its file. `part_of_node`: the mesh part of each node,
/// invalid for none.
std::vector<Clip> build_clips(const RawScene& scene, const SceneJoints& joints,
                              const std::vector<PartId>& part_of_node, const std::string& place,
                              IssueSink& issues);

}  // namespace skinforge
