#pragma once

#include "surface/triangle_patch.h"
#include "surface/wanted_surface.h"

namespace skinforge {

struct RemeshOptions {
  int passes = 6;                ///< ours: edge lengths settle after five on the real junctions
  double split_ratio = 4.0 / 3;  ///< Botsch and Kobbelt 2004
  double collapse_ratio = 4.0 / 5;
  double length_scale = 1;  ///< of the target lengths inside: below 1 the patch is finer than its borders
  double relax = 0.6;       ///< share of the way to the mean of the neighbours, in the tangent plane
};

/// Isotropic remeshing (Botsch and Kobbelt 2004: split, collapse, flip towards valence 6, tangential
/// relaxation, project) of the inside of a patch. Fixed vertices and the edges between them that lie on the
/// boundary never change. Target length: harmonic interpolation of the logarithm of the border's edge
/// lengths, so both neighbours' resolutions meet smoothly. Steps that would turn a face over, break
/// the manifold or join two fixed vertices by an inner edge (a chord, which may double an edge of the
/// preserved mesh, and over which weights would step) are left out. No projection: membrane (free vertices
/// relax in all directions).
TrianglePatch remesh(const TrianglePatch& patch, const Projection& project,
                     const RemeshOptions& options = {});

}  // namespace skinforge
