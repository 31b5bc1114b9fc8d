#pragma once

#include <optional>
#include <string>

#include "field/signed_distance.h"
#include "surface/junction_loop.h"
#include "surface/kept_surface.h"
#include "surface/patch_mirror.h"

namespace skinforge {

/// What a tube of quads is to join, to follow and to keep clear of.
struct TubeProblem {
  const std::vector<JunctionLoop>& loops;
  const DistanceField& field;
  const WantedSurface& surface;
  const KeptSurface& kept;
};

/// The best tube of quads (`QuadTube`) in the place of a triangulated patch between the problem's loops, two
/// or more: over several tables, numbers of rows and ways to place the vertices, the first that reaches the
/// targets of the least and the mean scaled Jacobian, else the one nearest to them that passes the gates of
/// its rung (`quad_gate.h`) and has no fault (`junction_faults.h`), settled (`FaceGoal`); by the first way to
/// see the patch as a tube that gives one. None, with the reason in `fault`, when there is none. `mirror`:
/// what mirroring does to the fixed vertices where the patch is its own image; then only tubes are made that
/// are, too, by a mirrored table between two borders, by a tube of one half between more.
std::optional<QuadPatch> best_tube(const TrianglePatch& patch, const TubeProblem& problem, std::string& fault,
                                   const PatchMirror* mirror = nullptr);

}  // namespace skinforge
