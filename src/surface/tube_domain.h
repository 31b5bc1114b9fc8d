#pragma once

#include <optional>
#include <vector>

#include "surface/borders.h"

namespace skinforge {

/// A vertex of a tube's border: where it lies on the boundary of the domain, and its name in the result.
struct TubeBorderPoint {
  double place = 0;         ///< along `TubeBorder::loop`, in vertices
  std::int32_t vertex = 0;  ///< in the result; twice on a border where a seam runs
};

/// One border of a tube, in the direction in which theta rises.
struct TubeBorder {
  IndexLoop loop;  ///< boundary of the domain
  std::vector<TubeBorderPoint> points;
  double depth = 0;  ///< of the preserved row before it, metres
};

/// A triangulated tube, and what its borders are made of. Where more than two borders are joined, seams turn
/// several into one (junction.md b.2, N loops): the patch is cut open along them, and both sides of a cut get
/// the same new vertices.
struct TubeDomain {
  TrianglePatch patch;
  TubeBorder a, b;
  std::vector<Vec3> seams;  ///< positions of the vertices on seams; named after the fixed ones
  std::size_t fixed = 0;    ///< border vertices of the whole
};

/// A patch between `loops` (its fixed vertices, loop after loop) as a tube: the first loop against all
/// others, these joined by the shortest seams. None when seams would touch.
std::optional<TubeDomain> tube_domain(const TrianglePatch& patch, const std::vector<JunctionLoop>& loops);

/// The same with two loops or more on either side, of all ways the one whose borders differ least in their
/// counts: a body between four limbs and a neck. None for less than four loops.
std::optional<TubeDomain> even_domain(const TrianglePatch& patch, const std::vector<JunctionLoop>& loops);

/// Depth of the first preserved row behind a border, so that rows go on at the same pace; near the border's
/// own edges where that row is much deeper or flatter than they are. Metres.
double row_depth(const JunctionLoop& loop);

/// Evenly spaced places, in vertices of the loop, along `edges` of its edges from vertex `begin` on, that cut
/// them into `pieces`; ends left out.
std::vector<double> spaced_places(const TrianglePatch& patch, const IndexLoop& loop, std::size_t begin,
                                  std::size_t edges, int pieces);

/// The same border run along the other way.
void turn_round(TubeBorder& border);

}  // namespace skinforge
