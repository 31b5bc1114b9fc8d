#pragma once

#include "surface/patch_mirror.h"
#include "surface/tube_domain.h"

namespace skinforge {

/// Ways to see the half of a symmetric patch above the plane as a tube (junction.md d.1): between a border
/// that lies above the plane and one made of the halves of those that cross it and of seams on the plane
/// between them, as the root of a wing on a back. The ways differ in the vertices on the seams, which let the
/// counts add up to an even number. None when the half has other than two borders, or when a border crosses
/// the plane between two vertices.
std::vector<TubeDomain> half_domains(const TrianglePatch& patch, const std::vector<JunctionLoop>& loops,
                                     const PatchMirror& borders);

/// A patch with its image, and what mirroring does to all vertices.
struct Unfolded {
  QuadPatch patch;
  PatchMirror mirror;
};

/// Quads made for a half domain, whose first vertices after the fixed ones, `on_plane` of them, lie on the
/// plane, together with their image.
Unfolded unfolded(const QuadPatch& half, std::size_t on_plane, const PatchMirror& borders);

}  // namespace skinforge
