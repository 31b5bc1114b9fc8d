#pragma once

#include "surface/patch_mirror.h"

namespace skinforge {

/// Moves free vertices sideways on the surface to where the faces around them are better (junction.md b.2,
/// step 6): damped Newton steps that shrink, a fixed number of rounds; all faces gain first, then the worst
/// above all. Better is a scaled Jacobian nearer to 1, less distance from the surface, and a place nearer to
/// the middle of the neighbours; a face that turns away from the surface is worse than any other.
/// With a mirror images move together, and what is on the plane stays there: a symmetric patch stays so.
void raise_worst(QuadPatch& patch, const WantedSurface& surface, const PatchMirror* mirror = nullptr);

/// `polish` (if `is_polished`) and `raise_worst` for a patch that is all but symmetric: it is so to the last
/// bit afterwards.
void polish_symmetric(QuadPatch& patch, const WantedSurface& surface, const PatchMirror& mirror,
                      bool is_polished);

}  // namespace skinforge
