#pragma once

#include <set>
#include <string>

#include "io/glb_buffer.h"
#include "io/glb_json.h"
#include "model/character.h"

namespace skinforge {

/// Writes the members "materials", "textures", "samplers" and "images", images as they are into `buffer`.
/// Equal textures and samplers are written once. Returns the glTF extensions that were used. Factors are cut
/// to the ranges of the format; emission above 1 goes into KHR_materials_emissive_strength.
std::set<std::string> write_materials(const Character& character, GlbBuffer& buffer, JsonText& json);

}  // namespace skinforge
