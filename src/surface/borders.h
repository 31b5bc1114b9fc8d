#pragma once

#include <vector>

#include "surface/junction_loop.h"
#include "surface/ring_zip.h"
#include "surface/triangle_patch.h"

namespace skinforge {

/// A loop by its indices into a patch.
using IndexLoop = std::vector<std::int32_t>;

/// Where a junction begins: its borders as the fixed vertices of a patch, loop after loop.
struct Borders {
  std::vector<IndexLoop> loops;
  TrianglePatch patch;  ///< fixed vertices, no triangles yet
};
Borders lay_borders(const std::vector<JunctionLoop>& loops);

std::vector<Vec3> positions_of(const TrianglePatch& patch, const IndexLoop& loop);

/// Adds the triangles between a border and a ring of the patch that run the same way.
void add_zip(TrianglePatch& patch, const IndexLoop& border, const IndexLoop& ring,
             const OutwardDirection& outward);

/// Adds triangles that fill a loop, running along it forwards.
void add_fill(TrianglePatch& patch, const IndexLoop& loop);

}  // namespace skinforge
