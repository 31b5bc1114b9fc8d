#pragma once

#include "surface/quad_patch.h"

namespace skinforge {

/// Moves free vertices of poor faces sideways on the surface as long as the least scaled Jacobian around them
/// rises (junction.md b.2, step 6): a search with shrinking steps, a fixed number of rounds. What is good
/// already stays.
void raise_worst(QuadPatch& patch, const Projection& project);

}  // namespace skinforge
