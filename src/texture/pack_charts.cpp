#include "texture/pack_charts.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "base/error.h"

namespace skinforge {
namespace {

constexpr double kDensityStep = 1.05;  // ours: packing is tried in steps of 5 %
constexpr double kEnough =
    0.85;  // ours: 15 % fewer texels a metre are hardly seen, twice the width costs four times
constexpr double kFreeDensity = 4;      // ours: in the smallest image; more shows nothing new
constexpr double kLeastDensity = 1e-6;  // ours: below it only the gutters are left
int cell_texels(double metres, double density, int gutter) {
  return static_cast<int>(std::ceil(std::min(metres * density, 1e6))) + 1 + 2 * gutter;
}

// Shelf packing in the order given into a square of side `packing.width`; false when that is too small.
bool place_on_shelves(std::span<const Chart> charts, const std::vector<std::size_t>& order,
                      const PackingOptions& options, ChartPacking& packing) {
  packing.origin.assign(charts.size(), Vec2::Zero());
  int x = 0, y = 0, shelf = 0;
  for (const std::size_t c : order) {
    const int width = cell_texels(charts[c].size.x(), packing.texels_per_metre, options.gutter);
    const int height = cell_texels(charts[c].size.y(), packing.texels_per_metre, options.gutter);
    if (x + width > packing.width) {
      x = 0;
      y += shelf;
      shelf = 0;
    }
    if (x + width > packing.width || y + height > packing.width) return false;
    packing.origin[c] = Vec2(x + options.gutter + 0.5, y + options.gutter + 0.5);
    x += width;
    shelf = std::max(shelf, height);
  }
  packing.height = packing.width;
  while (packing.height / 2 >= std::max(y + shelf, options.smallest)) packing.height /= 2;
  return true;
}

// The packing at the highest density in [least, most] (steps of kDensityStep down from `most`) that fits, if
// any.
std::optional<ChartPacking> densest_packing(std::span<const Chart> charts,
                                            const std::vector<std::size_t>& order,
                                            const PackingOptions& options, int width, double most,
                                            double least) {
  ChartPacking packing;
  packing.width = width;
  for (packing.texels_per_metre = most; packing.texels_per_metre >= least;
       packing.texels_per_metre /= kDensityStep)
    if (place_on_shelves(charts, order, options, packing)) return packing;
  return std::nullopt;
}

}  // namespace

ChartPacking pack_charts(std::span<const Chart> charts, const PackingOptions& options) {
  std::vector<std::size_t> order(charts.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return charts[a].size.y() > charts[b].size.y(); });
  const double wanted = options.texels_per_metre;
  for (int width = options.smallest; width <= options.largest; width *= 2) {
    const double most = width == options.smallest ? kFreeDensity * wanted : wanted;
    const double least = width == options.largest ? kLeastDensity * wanted : kEnough * wanted;
    if (auto packing = densest_packing(charts, order, options, width, most, least))
      return *std::move(packing);
  }
  throw Error(ExitCode::StageFailed, "the junction has too many charts for one texture of " +
                                         std::to_string(options.largest) + " texels");
}

}  // namespace skinforge
