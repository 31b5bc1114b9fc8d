#pragma once

#include "surface/face_badness.h"
#include "surface/patch_mirror.h"

namespace skinforge {

/// Moves free vertices sideways on the surface to where the faces around them are better (junction.md b.2,
/// step 6): damped Newton steps that shrink, a fixed number of rounds. Better is a scaled Jacobian nearer to
/// 1, less distance from the surface, and a place nearer to the middle of the neighbours (for the worst faces
/// these count little); a face that turns away from the surface is worse than any other.
/// With a mirror images move together, and what is on the plane stays there: a symmetric patch stays so if
/// the surface is (`mirrored`).
void improve_faces(QuadPatch& patch, const WantedSurface& surface, FaceGoal goal,
                   const PatchMirror* mirror = nullptr);

}  // namespace skinforge
