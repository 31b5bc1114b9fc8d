#include "render/canvas.h"

#include <gmock/gmock.h>

#include <set>

#include "render/font.h"
#include "render/shapes.h"

namespace skinforge {
namespace {

using testing::pixel;
constexpr std::array<int, 3> kWhite{255, 255, 255}, kBlack{0, 0, 0};

int dark_pixels(const Raster& raster) {
  int count = 0;
  for (int y = 0; y < raster.height; ++y)
    for (int x = 0; x < raster.width; ++x) count += pixel(raster, x, y) == kBlack ? 1 : 0;
  return count;
}

TEST(Canvas, TilesByHand) {
  const std::vector<Raster> pictures(3, blank_picture(4, 2, Vec3::Zero()));
  const Raster grid = tile(pictures, {.columns = 2, .gap = 1, .color = Vec3::Ones()});
  EXPECT_EQ(grid.width, 2 * 4 + 3);
  EXPECT_EQ(grid.height, 2 * 2 + 3);
  EXPECT_EQ(dark_pixels(grid), 3 * 4 * 2);
  EXPECT_EQ(pixel(grid, 0, 0), kWhite);
  EXPECT_EQ(pixel(grid, 1, 1), kBlack);
  EXPECT_EQ(pixel(grid, 5, 1), kWhite);
  EXPECT_EQ(pixel(grid, 6, 4), kWhite);  // the fourth cell is free
}

TEST(Canvas, NoPicturesGiveOnePixel) {
  EXPECT_EQ(tile({}).rgba.size(), 4U);
}

TEST(Canvas, PasteCutsAtTheRim) {
  Raster canvas = blank_picture(5, 5, Vec3::Ones());
  const Raster stamp = blank_picture(3, 3, Vec3::Zero());
  paste(canvas, stamp, -1, -2);
  EXPECT_EQ(dark_pixels(canvas), 2 * 1);
  paste(canvas, stamp, 4, 4);
  EXPECT_EQ(dark_pixels(canvas), 2 + 1);
  paste(canvas, stamp, 9, -9);
  EXPECT_EQ(dark_pixels(canvas), 3);
}

// The letter I: a bar of five between two serifs of three, so 11 pixels; at scale 2 four times as many.
TEST(Canvas, LabelByHand) {
  Raster canvas = blank_picture(20, 20, Vec3::Ones());
  label(canvas, 2, 3, "I", {.scale = 1, .color = Vec3::Zero(), .strength = 1});
  EXPECT_EQ(dark_pixels(canvas), 11);
  EXPECT_EQ(pixel(canvas, 3, 3), kBlack);
  label(canvas, 8, 3, "I", {.scale = 2, .color = Vec3::Zero(), .strength = 1});
  EXPECT_EQ(dark_pixels(canvas), 11 + 44);
  EXPECT_EQ(label_width("Walk", 2), 4 * 6 * 2);
}

TEST(Canvas, LabelOutsideIsCut) {
  Raster canvas = blank_picture(6, 6, Vec3::Ones());
  label(canvas, -100, 0, "M");
  label(canvas, 0, 100, "M");
  EXPECT_EQ(dark_pixels(canvas), 0);
}

TEST(Font, LettersDiffer) {
  std::set<Glyph> glyphs;
  for (char c = ' '; c <= '~'; ++c) glyphs.insert(glyph_of(c));
  EXPECT_EQ(glyphs.size(), 95U);
  EXPECT_FALSE(glyphs.contains(glyph_of('\xE9')));
  EXPECT_EQ(glyph_of('\n'), glyph_of('\xE9'));
}

}  // namespace
}  // namespace skinforge
