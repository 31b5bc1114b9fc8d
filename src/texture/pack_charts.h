#pragma once

#include <span>
#include <vector>

#include "texture/charts.h"

namespace skinforge {

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
