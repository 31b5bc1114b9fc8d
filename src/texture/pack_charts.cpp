#include "texture/pack_charts.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.h"

namespace skinforge {
namespace {

constexpr double kDensityStep = 1.1;  // ours: packing is tried in steps of 10 %

// Texels that a length takes up with its gutters; a point is one texel.
int cell_texels(double metres, double density, int gutter) {
  return static_cast<int>(std::ceil(std::min(metres * density, 1e6))) + 1 + 2 * gutter;
}

// Shelf packing in the order given; false when `size` is too small.
bool place_on_shelves(std::span<const Chart> charts, const std::vector<std::size_t>& order, int gutter,
                      ChartPacking& packing) {
  packing.origin.assign(charts.size(), Vec2::Zero());
  int x = 0, y = 0, shelf = 0;
  for (const std::size_t c : order) {
    const int width = cell_texels(charts[c].size.x(), packing.texels_per_metre, gutter);
    const int height = cell_texels(charts[c].size.y(), packing.texels_per_metre, gutter);
    if (x + width > packing.size) {
      x = 0;
      y += shelf;
      shelf = 0;
    }
    if (x + width > packing.size || y + height > packing.size) return false;
    packing.origin[c] = Vec2(x + gutter + 0.5, y + gutter + 0.5);
    x += width;
    shelf = std::max(shelf, height);
  }
  return true;
}

}  // namespace

ChartPacking pack_charts(std::span<const Chart> charts, const PackingOptions& options) {
  std::vector<std::size_t> order(charts.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return charts[a].size.y() > charts[b].size.y(); });

  ChartPacking packing;
  packing.size = options.smallest;
  packing.texels_per_metre = options.texels_per_metre;
  while (!place_on_shelves(charts, order, options.gutter, packing)) {
    if (packing.size < options.largest)
      packing.size *= 2;
    else
      packing.texels_per_metre /= kDensityStep;
    if (packing.texels_per_metre < 1e-6 * options.texels_per_metre)
      throw Error(ExitCode::StageFailed, "the junction has too many charts for one texture of " +
                                             std::to_string(options.largest) + " texels");
  }
  for (ChartPacking denser = packing;;) {
    denser.texels_per_metre *= kDensityStep;
    if (denser.texels_per_metre > 4 * options.texels_per_metre ||  // ours: more shows nothing new
        !place_on_shelves(charts, order, options.gutter, denser))
      break;
    packing = denser;
  }
  return packing;
}

}  // namespace skinforge
