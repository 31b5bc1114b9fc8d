#pragma once

#include <optional>
#include <string>

#include "surface/junction_loop.h"
#include "surface/quad_patch.h"

namespace skinforge {

/// A tube of quads between two borders that continues their rows (junction.md b.2): rung 2. `domain`: a
/// triangulated tube between the same borders, as rung 1 gives it; it says where the quads lie, not how they
/// run. `project` brings a free vertex back onto the wanted surface. Fixed vertices as in `domain`. One
/// triangle when the borders' counts add up to an odd number. None, with the reason in `fault`, when the
/// domain is no tube or the counts cannot meet.
std::optional<QuadPatch> quad_tube(const TrianglePatch& domain, const std::vector<JunctionLoop>& loops,
                                   const Projection& project, std::string& fault);

}  // namespace skinforge
