#include "render/shrink.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace skinforge {

namespace {
// Pixels [first, last) of one side that a pixel of the shrunk picture covers; at least one.
struct Cover {
  int first = 0, last = 1;
};

Cover cover(int pixel, int from, int to) {
  const auto edge = [&](int p) { return static_cast<int>(std::int64_t{p} * from / to); };
  return {edge(pixel), std::max(edge(pixel + 1), edge(pixel) + 1)};
}

std::array<std::uint8_t, 4> mean(const Raster& raster, const Cover& x, const Cover& y) {
  std::array<std::uint32_t, 4> sum{};
  for (int row = y.first; row < y.last; ++row)
    for (int column = x.first; column < x.last; ++column)
      for (std::size_t c = 0; c < 4; ++c)
        sum[c] += raster.rgba[4 * (static_cast<std::size_t>(row) * raster.width + column) + c];
  const auto count = static_cast<std::uint32_t>((x.last - x.first) * (y.last - y.first));
  std::array<std::uint8_t, 4> pixel;
  for (std::size_t c = 0; c < 4; ++c) pixel[c] = static_cast<std::uint8_t>((sum[c] + count / 2) / count);
  return pixel;
}
}  // namespace

Raster shrunk(const Raster& raster, int width) {
  if (raster.width <= width) return raster;
  Raster small;
  small.width = width;
  small.height = std::max(1, static_cast<int>(std::lround(double(raster.height) * width / raster.width)));
  small.rgba.reserve(std::size_t{4} * small.width * small.height);
  for (int row = 0; row < small.height; ++row)
    for (int column = 0; column < width; ++column) {
      const auto pixel =
          mean(raster, cover(column, raster.width, width), cover(row, raster.height, small.height));
      small.rgba.insert(small.rgba.end(), pixel.begin(), pixel.end());
    }
  return small;
}

}  // namespace skinforge
