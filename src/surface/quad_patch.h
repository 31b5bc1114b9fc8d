#pragma once

#include <array>
#include <vector>

#include "surface/triangle_patch.h"
#include "surface/wanted_surface.h"

namespace skinforge {

using Quad = std::array<std::int32_t, 4>;

/// New surface of quads, and a triangle where the counts of its borders ask for one. Its first `fixed`
/// vertices are border vertices of the preserved meshes, as in a TrianglePatch.
struct QuadPatch {
  std::vector<Vec3> positions;  ///< metres, model space
  std::vector<Quad> quads;
  std::vector<Triangle> triangles;
  std::size_t fixed = 0;
};

/// The least scaled Jacobian of its faces (`scaled_jacobian.h`).
double least_scaled_jacobian(const QuadPatch& patch);

/// Their mean; 1 without faces.
double mean_scaled_jacobian(const QuadPatch& patch);

/// Moves free vertices towards the mean of the rectangles that fit their faces best, and a little towards the
/// mean of their neighbours, and projects them, a fixed number of times (junction.md b.2, step 6).
void polish(QuadPatch& patch, const Projection& project);

/// Each quad as two triangles, cut along its shorter diagonal (ties: from its first vertex); the pair of quad
/// k stands at 2 k and 2 k + 1, and both begin at the same end of the diagonal.
TrianglePatch halved(const QuadPatch& patch);

}  // namespace skinforge
