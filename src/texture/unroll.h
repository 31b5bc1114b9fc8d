#pragma once

#include <optional>
#include <span>

#include "texture/charts.h"

namespace skinforge {

/// Lays a ring-shaped surface (an annulus: the usual junction between two borders) flat as one strip, or
/// returns nothing. `members`: indices into `faces` of one connected surface; `mesh` and `faces` as for
/// `grow_charts`.
/// 1. Two border loops, Euler number 0, every edge with at most two faces; else nothing.
/// 2. Cut along the shortest path of edges from loop to loop.
/// 3. x runs round the ring, y from loop to loop: both harmonic with mean value weights (Floater 2003), x
/// fixed on each loop
///    by arc length from the cut and growing by one period across it, y fixed to 0 and 1. Straight borders
///    and positive weights leave no triangle turned over.
/// 4. Scaled so that x and y stretch alike over the whole surface and the area stays.
/// Nothing, too, when a triangle is turned over all the same (rounding, degenerate input) or when more than a
/// twentieth of the area is squeezed or stretched in some direction by more than `kMostStretch`: projection
/// does better there (cones, flat rings).
std::optional<Chart> unroll_annulus(const PolygonMesh& mesh, std::span<const FaceId> faces,
                                    std::span<const std::size_t> members);

/// Charts for any surface, part by part (connected across edges, by lowest face): one projected chart where
/// that is enough, one strip where `unroll_annulus` gives it, else the charts of `grow_charts`.
std::vector<Chart> make_charts(const PolygonMesh& mesh, std::span<const FaceId> faces,
                               const ChartOptions& options = {});

}  // namespace skinforge
