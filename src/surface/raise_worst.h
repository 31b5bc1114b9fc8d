#pragma once

#include "surface/quad_patch.h"

namespace skinforge {

/// Moves free vertices of poor faces sideways on the surface as long as the least quality around them rises
/// (junction.md b.2, step 6): a search with shrinking steps, a fixed number of rounds. Quality is the scaled
/// Jacobian, negative where a face turns away from the surface. What is good already stays.
void raise_worst(QuadPatch& patch, const WantedSurface& surface);

}  // namespace skinforge
