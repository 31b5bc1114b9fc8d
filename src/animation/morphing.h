#pragma once

#include <vector>

#include "model/character.h"

namespace skinforge {

/// Positions of the mesh in the bind pose with the morph targets of the character added, by the weights that
/// `clip` gives at `time` seconds (glTF morphs first and skins after), or their default where it has no
/// track. A vertex that several parts share moves as in the first of them. #V.
std::vector<Vec3> morphed_positions(const Character& character, const Clip& clip, double time);

}  // namespace skinforge
