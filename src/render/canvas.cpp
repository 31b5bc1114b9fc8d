#include "render/canvas.h"

#include <algorithm>
#include <vector>

#include "base/expect.h"
#include "render/color.h"
#include "render/font.h"

namespace skinforge {
namespace {

std::uint8_t* pixel_at(Raster& picture, int x, int y) {
  return picture.rgba.data() + 4 * (static_cast<std::size_t>(y) * picture.width + x);
}

bool is_inside(const Raster& picture, int x, int y) {
  return x >= 0 && y >= 0 && x < picture.width && y < picture.height;
}

void blend(Raster& picture, int x, int y, const Vec3& color, double strength) {
  if (!is_inside(picture, x, y)) return;
  auto* pixel = pixel_at(picture, x, y);
  for (int k = 0; k < 3; ++k) {
    const double under = linear_from_srgb(pixel[k]);
    pixel[k] = srgb_from_linear(static_cast<float>(under + strength * (color[k] - under)));
  }
}

void draw_letter(Raster& picture, int x, int y, char letter, const LabelOptions& options) {
  const Glyph& glyph = glyph_of(letter);
  for (int row = 0; row < kGlyphRows * options.scale; ++row)
    for (int column = 0; column < kGlyphColumns * options.scale; ++column)
      if (is_inked(glyph, column / options.scale, row / options.scale))
        blend(picture, x + column, y + row, options.color, options.strength);
}

}  // namespace

Raster blank_picture(int width, int height, const Vec3& color) {
  SF_EXPECT(width > 0 && height > 0);
  Raster picture{width, height, {}};
  picture.rgba.resize(4 * static_cast<std::size_t>(width) * height, 255);
  for (std::size_t i = 0; i < picture.rgba.size(); i += 4)
    for (std::size_t k = 0; k < 3; ++k)
      picture.rgba[i + k] = srgb_from_linear(static_cast<float>(color[static_cast<int>(k)]));
  return picture;
}

void paste(Raster& canvas, const Raster& picture, int x, int y) {
  const int first = std::max(0, -x), last = std::min(picture.width, canvas.width - x);
  if (first >= last) return;
  for (int row = std::max(0, -y); row < std::min(picture.height, canvas.height - y); ++row) {
    const auto* from = picture.rgba.data() + 4 * (static_cast<std::size_t>(row) * picture.width + first);
    std::copy_n(from, 4 * static_cast<std::size_t>(last - first), pixel_at(canvas, x + first, y + row));
  }
}

Raster tile(std::span<const Raster> pictures, const TileOptions& options) {
  if (pictures.empty()) return blank_picture(1, 1, options.color);
  const int count = static_cast<int>(pictures.size());
  const int columns = options.columns > 0 ? std::min(options.columns, count) : count;
  const int rows = (count + columns - 1) / columns;
  int width = 0, height = 0;
  for (const Raster& picture : pictures) {
    width = std::max(width, picture.width);
    height = std::max(height, picture.height);
  }
  Raster canvas = blank_picture(columns * (width + options.gap) + options.gap,
                                rows * (height + options.gap) + options.gap, options.color);
  for (int i = 0; i < count; ++i) {
    const Raster& picture = pictures[static_cast<std::size_t>(i)];
    paste(canvas, picture, options.gap + i % columns * (width + options.gap) + (width - picture.width) / 2,
          options.gap + i / columns * (height + options.gap) + (height - picture.height) / 2);
  }
  return canvas;
}

void label(Raster& picture, int x, int y, std::string_view text, const LabelOptions& options) {
  for (const char letter : text) {
    draw_letter(picture, x, y, letter, options);
    x += kLetterWidth * options.scale;
  }
}

int label_width(std::string_view text, int scale) {
  return static_cast<int>(text.size()) * kLetterWidth * scale;
}

}  // namespace skinforge
