#pragma once

#include <optional>
#include <span>

#include "surface/tube_table.h"

namespace skinforge {

/// How mirroring renames the vertices of a closed loop of n: i becomes sum - i, modulo n.
struct LoopReflection {
  int sum = 0;
};

/// The reflection that the images of a loop's vertices are; none when they are not.
std::optional<LoopReflection> loop_reflection(std::span<const std::int32_t> loop,
                                              std::span<const std::int32_t> images);

/// The cheapest columns that are mirror images of each other (junction.md d.1, step 2): those of `solve_tube`
/// from one crossing of the plane to the other, and their images. In a crossing stands nothing where a column
/// ends on the plane, or a column that is its own image: a match between two edges that cross the plane, a
/// stack about a vertex on it (it counts half), a triangle where an edge faces a vertex. None where two
/// triangles would be needed (quads cannot lie on a plane that meets one border in vertices and the other in
/// edges), or a diamond on an edge. O(#a * #b * deepest^2).
std::optional<TubeTable> solve_symmetric_tube(const TubeSide& a, LoopReflection on_a, const TubeSide& b,
                                              LoopReflection on_b, int rows, const TubeOptions& options = {});

}  // namespace skinforge
