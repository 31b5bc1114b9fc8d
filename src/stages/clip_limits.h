#pragma once

#include "model/character.h"

namespace skinforge {

/// Refuses clips that would take too many frames or too much memory where they are resampled (`kSearchRate`,
/// for the whole input at once), before anything is allocated for them. Throws Error (BadInput) with the
/// numbers and the limit to raise.
void expect_clips_in_limits(const Character& character);

}  // namespace skinforge
