#pragma once

#include "surface/quad_patch.h"

namespace skinforge {

/// Moves free vertices sideways on the surface to where the faces around them are better (junction.md b.2,
/// step 6): damped Newton steps that shrink, a fixed number of rounds; all faces gain first, then the worst
/// above all. Better is a scaled Jacobian nearer to 1, less distance from the surface, and a place nearer to
/// the middle of the neighbours; a face that turns away from the surface is worse than any other.
void raise_worst(QuadPatch& patch, const WantedSurface& surface);

}  // namespace skinforge
