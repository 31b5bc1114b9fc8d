#pragma once

#include <optional>
#include <vector>

#include "base/math.h"
#include "model/polygon_mesh.h"

namespace skinforge {

/// The line of presence 1/2 on a mesh: where a cut runs.
struct CutLine {
  Vec3 centre = Vec3::Zero();  ///< mean over its length, metres
  double length = 0;           ///< girth, metres
};

/// The longest connected piece of that line; none when no edge crosses 1/2.
std::optional<CutLine> longest_cut_line(const PolygonMesh& mesh, const std::vector<double>& presence);

}  // namespace skinforge
