#pragma once

#include <span>
#include <vector>

#include "model/clip.h"
#include "model/skeleton.h"

namespace skinforge {

/// Leaves out keys of the tracks of the joints marked in `is_reducible` (one per joint of the skeleton), as
/// long as no point of the skin is moved by more than `tolerance` (metres) at any of `times`, the keys that
/// those tracks have, equally spaced (a track may instead have one key, which stays). First and last keys
/// stay, and of a loop the keys beside them. `radii`: per joint, metres: its skin lies within this distance
/// of it in the bind pose. A vertex lies between the places that its joints give it, so bounding the motion
/// of these balls bounds the skin, whatever the weights. 0 or less leaves all keys. Between the keys both
/// tracks turn at a steady speed, so the keys tell. Cost: keys x joints, a few times.
void reduce_keys(Clip& clip, const Skeleton& skeleton, const std::vector<bool>& is_reducible,
                 std::span<const double> times, std::span<const double> radii, double tolerance,
                 bool is_loop = false);

}  // namespace skinforge
