#pragma once

#include <span>
#include <vector>

#include "model/polygon_mesh.h"

namespace skinforge {

struct ChartOptions {
  /// A face joins a chart while its normal is within this angle of the chart's axis; 0 gives every face a
  /// chart of its own. Stretch stays below 1 / cos, so 1.4 at the default.
  double max_turn_deg = 45;
};

/// Part of a surface laid flat: faces and their corners in metres, in the plane of the chart.
struct Chart {
  std::vector<std::size_t> faces;          ///< indices into the `faces` given, rising
  std::vector<std::vector<Vec2>> corners;  ///< per face, per corner; the lowest x and y of the chart are 0
  Vec2 size = Vec2::Zero();                ///< metres; x is the longer side
};

/// Cuts the surface made of `faces` into charts that are flat enough to be projected: from the lowest face
/// without a chart, faces join across shared edges, the one turned least first, as long as `max_turn_deg`
/// holds and no projected triangle overlaps another one of the chart. So a UV point belongs to one point of
/// the surface. A face that is folded in itself still gets a chart (alone); a face without area gets a chart
/// of size 0. Cost: quadratic in the faces of one chart. (Not the paper, which has no texture on the
/// junction; design by normals as in many atlas tools.)
std::vector<Chart> grow_charts(const PolygonMesh& mesh, std::span<const FaceId> faces,
                               const ChartOptions& options = {});

}  // namespace skinforge
