#pragma once

#include <string_view>
#include <vector>

#include "animation/keyframe_distance.h"

namespace skinforge {

/// Whether two clips are called alike: after the last '|' ("Armature|Walk"), some word of three letters or
/// more begins some word of the other, case ignored (Walk, Walking_A).
bool share_a_word(std::string_view a, std::string_view b);

/// Adds what the paper's distance does not see (ours, completion.md): the difference in liveliness, and a
/// constant for clips of another name when the set has clips called like the driving one. `first`: the
/// table's first row in the driver's frames. `same_name`: per clip of the candidates.
void add_behaviour(const MotionSet& driver, std::size_t first, const MotionSet& candidates,
                   const std::vector<bool>& same_name, DistanceTable& distances);

}  // namespace skinforge
