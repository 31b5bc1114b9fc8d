#pragma once

#include <string>
#include <vector>

#include "base/issue.h"
#include "io/build_character_joints.h"
#include "model/character.h"

namespace skinforge {

/// The clips of a scene: `build_character.md`, steps 7 and 8. All keys as they are, except on the joints at
/// the top, which take `metres_from_file`.
std::vector<Clip> build_clips(const RawScene& scene, const JointTable& joints,
                              const std::vector<PartId>& part_of_node, const std::string& place,
                              IssueSink& issues);

}  // namespace skinforge
