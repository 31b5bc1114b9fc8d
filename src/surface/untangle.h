#pragma once

#include "surface/junction_loop.h"
#include "surface/kept_surface.h"
#include "surface/triangle_patch.h"

namespace skinforge {

/// A patch whose intersecting faces are drawn apart: their free vertices move to the middle of their
/// neighbours, up to a few times, until nothing intersects. Connectivity stays. What does not come apart is
/// left as it then is; compare `faults_of`. Cost: one test for self-intersection a round.
TrianglePatch untangled(TrianglePatch patch, const std::vector<JunctionLoop>& loops, const KeptSurface& kept);

}  // namespace skinforge
