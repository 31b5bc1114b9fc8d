#pragma once

#include <span>
#include <vector>

#include "surface/quad_patch.h"
#include "surface/tube_table.h"

namespace skinforge {

/// The faces of a tube, without geometry: vertices 0 .. #a - 1 are border A, then border B in its own order,
/// then the new ones row by row. Faces run along A forwards.
struct TubeMesh {
  std::vector<Quad> quads;
  std::vector<Triangle> triangles;
  std::vector<int> row;       ///< per vertex: 0 on A, `rows` on B
  std::vector<double> theta;  ///< per vertex, in turns: where its column lies
};

/// Reads the faces off a table (junction.md b.2, steps 4 and 5): watertight and manifold by construction. The
/// rows beside the borders are whole, so the borders' own rows go on, except where a border turns in by more
/// than a notch: there a stack begins at once. `height`: per row 0 .. `rows`, its share of the way from A to
/// B.
TubeMesh mesh_of(const TubeTable& table, const TubeSide& a, const TubeSide& b,
                 std::span<const double> height);

}  // namespace skinforge
