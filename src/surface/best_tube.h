#pragma once

#include <optional>
#include <string>

#include "field/signed_distance.h"
#include "surface/junction_loop.h"
#include "surface/quad_patch.h"

namespace skinforge {

/// The best tube of quads (`QuadTube`) in the place of a triangulated patch between two or more borders: over
/// several tables and numbers of rows, the first that reaches the target of the least scaled Jacobian, else
/// the one with the highest that passes the gates of its rung (`quad_gate.h`); by the first way to see the
/// patch as a tube that gives one. None, with the reason in `fault`, when there is none.
std::optional<QuadPatch> best_tube(const TrianglePatch& patch, const std::vector<JunctionLoop>& loops,
                                   const DistanceField& field, const WantedSurface& surface,
                                   std::string& fault);

}  // namespace skinforge
