#pragma once

#include <optional>
#include <string>

#include "field/signed_distance.h"
#include "surface/junction_loop.h"
#include "surface/quad_patch.h"

namespace skinforge {

/// The best tube of quads (`QuadTube`) between two or more borders in the place of a triangulated patch: over
/// the ways to see it as a tube, several tables and numbers of rows, the first that reaches the target of the
/// least scaled Jacobian, else the one with the highest that passes the gates of its rung (`quad_gate.h`).
/// None, with the reason in `fault`, when there is none.
std::optional<QuadPatch> best_tube(const TrianglePatch& patch, const std::vector<JunctionLoop>& loops,
                                   const DistanceField& field, const Projection& project, std::string& fault);

}  // namespace skinforge
