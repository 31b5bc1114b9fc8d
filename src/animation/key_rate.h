#pragma once

#include <optional>

#include "model/clip.h"

namespace skinforge {

/// Keys a second of a clip that is keyed at equal steps: those of its track with the most keys, where nine of
/// ten steps between them are alike. None for other clips (an animator's few keys, or what a key reduction
/// left) and for rates outside of [10, 120].
std::optional<double> own_key_rate(const Clip& clip);

/// Angle per second between neighbouring keys of linear rotation tracks, largest over the joints; keys less
/// than 1/120 s apart are left out.
double fastest_keyed_turn(const Clip& clip);

}  // namespace skinforge
