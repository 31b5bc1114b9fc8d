#pragma once

#include <string>
#include <vector>

#include "model/character.h"

namespace skinforge {

/// Gives `result` the materials and images of the inputs that its faces use, in the order of the inputs, and
/// turns the material ids of its faces (those of their own input) into the result's. `input_of_face`: -1 for
/// faces without an input. A material keeps its name; where it is taken, it becomes `<input>_<name>`.
void merge_materials(Character& result, const std::vector<const Character*>& inputs,
                     const std::vector<std::string>& input_names,
                     const std::vector<std::int32_t>& input_of_face);

}  // namespace skinforge
