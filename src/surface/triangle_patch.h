#pragma once

#include <array>
#include <span>
#include <vector>

#include "base/math.h"

namespace skinforge {

using Triangle = std::array<std::int32_t, 3>;

/// New surface in the making: triangles whose first `fixed` vertices are border vertices of the preserved
/// meshes. Those keep their index and position through every step, which is what makes the result watertight
/// by construction.
struct TrianglePatch {
  std::vector<Vec3> positions;  ///< metres, model space
  std::vector<Triangle> triangles;
  std::size_t fixed = 0;
};

/// Directed boundary loops of a triangle list: each edge in the direction in which its one triangle runs
/// along it. A vertex where several boundary loops touch is passed once per fan. Triangles must be
/// edge-manifold and consistently oriented; loops start at their lowest vertex and are sorted by it.
std::vector<std::vector<std::int32_t>> boundary_loops(std::span<const Triangle> triangles);

/// Connected component (by shared vertices) of each triangle, numbered by lowest triangle; returns the count
/// as well.
std::pair<std::vector<std::int32_t>, std::int32_t> triangle_components(std::span<const Triangle> triangles,
                                                                       std::size_t vertex_count);

/// Copy with the vertices that no triangle uses left out (fixed ones always stay).
TrianglePatch without_unused_vertices(const TrianglePatch& patch);

/// Length of a closed polyline.
double loop_length(std::span<const Vec3> loop);

}  // namespace skinforge
