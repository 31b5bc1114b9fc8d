#pragma once

#include <string_view>
#include <vector>

#include "animation/keyframe_distance.h"

namespace skinforge {

/// Whether two clips are called alike: after the last '|' ("Armature|Walk"), some word of three letters or
/// more begins some word of the other, case ignored (Walk, Walking_A).
bool share_a_word(std::string_view a, std::string_view b);

/// Turns windowed keyframe distances into what a keyframe costs (ours, completion.md): half the distance, so
/// that extreme poses stay dear; plus the distance relative to how far both frames are from their usual
/// stances, so that standing still is not the safest answer to everything; plus the difference in liveliness,
/// as far as both sets know calm and lively clips; plus a constant for clips of another name where the set
/// has clips called like the driving one. 0 for the same frame of the same motion. `first`: the table's first
/// row in the driver's frames. `same_name`: per clip of the candidates.
void add_behaviour(const MotionSet& driver, std::size_t first, const MotionSet& candidates,
                   const std::vector<bool>& same_name, DistanceTable& distances);

}  // namespace skinforge
