#pragma once

#include <span>
#include <vector>

#include "texture/charts.h"

namespace skinforge {

/// Places of the charts in an image.
struct ChartPacking {
  int width = 0;   ///< texels, a power of two
  int height = 0;  ///< likewise, at most `width`
  double texels_per_metre = 0;
  std::vector<Vec2> origin;  ///< per chart: where its corner (0, 0) comes to lie, texels
};

struct PackingOptions {
  double texels_per_metre = 0;  ///< wanted
  int smallest = 64;            ///< texels a side; powers of two
  int largest = 1024;
  int gutter = 2;  ///< free texels around each chart
};

/// Packs the charts by shelves, highest first, into the smallest image that holds them at the wanted density:
/// a square power of two, its lower half cut off as long as it is empty. A density up to 15 % lower is taken
/// rather than twice the width, a higher one only where the smallest image has room. If not even the largest
/// image holds them, the density falls until it does. No two charts come nearer than two gutters. Corner (0,
/// 0) of a chart sits on a texel centre. Throws Error (StageFailed) if the gutters alone do not fit.
ChartPacking pack_charts(std::span<const Chart> charts, const PackingOptions& options);

}  // namespace skinforge
