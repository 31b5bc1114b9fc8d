#pragma once

#include "surface/junction.h"

namespace skinforge {

/// Laplacian rounds over the new vertices of a junction: each goes half of the way to the mean of its
/// neighbours along edges (of quads, not their diagonals), all at once, so the order of vertices does not
/// matter. Borders stay, and so do vertices of quads that would fall below the least scaled Jacobian that a
/// tube must reach. Where `rounds` would bring faults, half as many are tried, and so on. Returns the rounds
/// made; the faults stay up to date.
int smooth_junction(Junction& junction, const KeptSurface& kept, int rounds);

}  // namespace skinforge
