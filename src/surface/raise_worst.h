#pragma once

#include "surface/patch_mirror.h"

namespace skinforge {

/// Moves free vertices of poor faces sideways on the surface as long as the least quality around them rises
/// (junction.md b.2, step 6): a search with shrinking steps, a fixed number of rounds. Quality is the scaled
/// Jacobian, negative where a face turns away from the surface. What is good already stays.
/// With a mirror images move together, and what is on the plane stays there: a symmetric patch stays so.
void raise_worst(QuadPatch& patch, const WantedSurface& surface, const PatchMirror* mirror = nullptr);

/// `polish` and `raise_worst` for a patch that is all but symmetric: it is so to the last bit afterwards.
void polish_symmetric(QuadPatch& patch, const WantedSurface& surface, const PatchMirror& mirror);

}  // namespace skinforge
