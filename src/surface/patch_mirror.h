#pragma once

#include <optional>
#include <span>
#include <vector>

#include "geometry/mirror_symmetry.h"
#include "surface/quad_patch.h"

namespace skinforge {

/// A mirror plane and what it does to vertices: of a junction's borders, loop after loop, or of a whole
/// patch.
struct PatchMirror {
  MirrorPlane plane;
  std::vector<std::int32_t> image;  ///< per vertex; itself on the plane
};

/// The images of all vertices of a patch, read off its faces alone, from those of its fixed vertices
/// outwards: an edge's image is run along backwards, so the rest follows face by face. None when the faces
/// are not mirror images of each other: the connectivity is not symmetric. O(n log n).
std::optional<PatchMirror> mirror_of(const QuadPatch& patch, const PatchMirror& borders);

/// Moves free vertices to the mean with the mirrored places of their images, so that what was all but
/// symmetric is so to the last bit; those on the plane onto it. Fixed vertices stay.
void make_symmetric(QuadPatch& patch, const PatchMirror& mirror);

/// The same surface on both sides: below the plane it is the mirror image of what it is above. Refers to
/// `surface`.
WantedSurface mirrored(const WantedSurface& surface, const MirrorPlane& plane);

}  // namespace skinforge
