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

/// Places of the charts in a square image.
struct ChartPacking {
  int size = 0;  ///< texels a side
  double texels_per_metre = 0;
  std::vector<Vec2> origin;  ///< per chart: where its corner (0, 0) comes to lie, texels
};

struct PackingOptions {
  double texels_per_metre = 0;  ///< wanted
  int smallest = 64;            ///< texels a side; powers of two
  int largest = 1024;
  int gutter = 2;  ///< free texels around each chart
};

/// Packs the charts by shelves, highest first, into the smallest power of two that holds them at the wanted
/// density; then takes up the rest of the image by a higher density. If not even the largest image holds
/// them, the density falls until it does. No two charts come nearer than two gutters. Corner (0, 0) of a
/// chart sits on a texel centre. Throws Error (StageFailed) if the gutters alone do not fit.
ChartPacking pack_charts(std::span<const Chart> charts, const PackingOptions& options);

}  // namespace skinforge
