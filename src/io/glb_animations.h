#pragma once

#include <map>

#include "io/glb_buffer.h"
#include "io/glb_json.h"
#include "model/character.h"

namespace skinforge {

/// Writes the member "animations": one glTF animation a clip, joint j driven as node j, morph weights of a
/// part through the node that `morph_nodes` gives for it. Keys are rounded to float and otherwise unchanged;
/// of keys whose times become equal by that the first stays. A clip that starts before 0 is moved to start
/// there (glTF has no negative times); one without tracks holds the root at its bind translation for its
/// duration. Key times and values that occur more than once are stored once.
void write_animations(const Character& character, const std::map<PartId, std::size_t>& morph_nodes,
                      GlbBuffer& buffer, JsonText& json);

}  // namespace skinforge
