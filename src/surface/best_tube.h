#pragma once

#include <optional>
#include <string>

#include "field/signed_distance.h"
#include "surface/junction_loop.h"
#include "surface/patch_mirror.h"

namespace skinforge {

/// The best tube of quads (`QuadTube`) in the place of a triangulated patch between two or more borders: over
/// several tables and numbers of rows, the first that reaches the target of the least scaled Jacobian, else
/// the one with the highest that passes the gates of its rung (`quad_gate.h`); by the first way to see the
/// patch as a tube that gives one. None, with the reason in `fault`, when there is none. `mirror`: what
/// mirroring does to the fixed vertices where the patch is its own image; then only tubes are made that
/// are, too, by a mirrored table between two borders, by a tube of one half between more.
std::optional<QuadPatch> best_tube(const TrianglePatch& patch, const std::vector<JunctionLoop>& loops,
                                   const DistanceField& field, const WantedSurface& surface,
                                   std::string& fault, const PatchMirror* mirror = nullptr);

}  // namespace skinforge
