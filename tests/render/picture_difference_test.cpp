#include "render/picture_difference.h"

#include <gtest/gtest.h>

#include <random>

#include "render/draw.h"
#include "render/shapes.h"

namespace skinforge {
namespace {
using testing::add_square;
using testing::empty_mesh;
using testing::pixel;
using testing::unlit;

constexpr double kRounding = 1e-12;

// All pixels of one grey, covered by a character.
Raster flat(int size, int grey) {
  Raster raster{size, size, {}};
  for (int i = 0; i < size * size; ++i)
    for (const int value : {grey, grey, grey, 255}) raster.rgba.push_back(static_cast<std::uint8_t>(value));
  return raster;
}

void set(Raster& raster, int x, int y, int grey, int coverage = 255) {
  auto* p = raster.rgba.data() + 4 * (static_cast<std::ptrdiff_t>(y) * raster.width + x);
  for (int k = 0; k < 3; ++k) p[k] = static_cast<std::uint8_t>(grey);
  p[3] = static_cast<std::uint8_t>(coverage);
}

Raster noise(int size, unsigned seed) {
  std::mt19937 random(seed);
  Raster raster{size, size, {}};
  for (int i = 0; i < 4 * size * size; ++i) raster.rgba.push_back(static_cast<std::uint8_t>(random() % 256));
  return raster;
}

// By hand: of 64 pixels one differs by 100 of 255, and nothing near it has its colour.
TEST(PictureDifference, OfOnePixel) {
  const Raster a = flat(8, 50);
  Raster b = a;
  set(b, 3, 4, 150);
  const PictureDifference found = picture_difference(a, b);
  EXPECT_NEAR(found.changed, 1.0 / 64, kRounding);
  EXPECT_NEAR(found.mean_error, 100.0 / 255 / 64, kRounding);
  EXPECT_LT(found.ssim, 1);
  EXPECT_EQ(found.overlap, 1);
}

// By hand: without variance SSIM is (2 x y + C1) / (x^2 + y^2 + C1), C1 = 2.55^2.
TEST(PictureDifference, SimilarityOfTwoGreys) {
  const double c1 = 2.55 * 2.55;
  EXPECT_NEAR(picture_difference(flat(16, 100), flat(16, 50)).ssim, (2 * 100 * 50 + c1) / (12500 + c1), 1e-9);
}

// An outline between two pixels may lie anywhere: 10 | 90 | 170 becomes 10 | 60 | 170. An outline that moves
// by two pixels, or a colour that neither side has, is a change.
TEST(PictureDifference, OutlinesMayMoveByAPartOfAPixel) {
  const auto edge = [](int at, int between) {
    Raster raster = flat(16, 10);
    for (int y = 0; y < 16; ++y) {
      set(raster, at, y, between);
      for (int x = at + 1; x < 16; ++x) set(raster, x, y, 170);
    }
    return raster;
  };
  EXPECT_EQ(picture_difference(edge(7, 90), edge(7, 60)).changed, 0);
  EXPECT_EQ(picture_difference(edge(7, 90), edge(7, 220)).changed, 1.0 / 16);
  EXPECT_GT(picture_difference(edge(7, 90), edge(9, 90)).changed, 0);
  EXPECT_EQ(picture_difference(flat(8, 50), flat(8, 58)).changed, 0);  // a step the eye does not see
  EXPECT_EQ(picture_difference(flat(8, 50), flat(8, 59)).changed, 1);
}

// By hand: A covers the left half and B all: they share half. Where neither is, nothing counts.
TEST(PictureDifference, OnlyTheCharacterCounts) {
  Raster a = flat(8, 50), b = flat(8, 50);
  for (int y = 0; y < 8; ++y)
    for (int x = 4; x < 8; ++x) set(a, x, y, 200, 0);
  EXPECT_NEAR(picture_difference(a, b).overlap, 0.5, kRounding);
  EXPECT_NEAR(picture_difference(a, b).mean_error, 150.0 / 255 / 2, kRounding);
  for (int y = 0; y < 8; ++y)
    for (int x = 4; x < 8; ++x) set(b, x, y, 20, 0);
  EXPECT_EQ(picture_difference(a, b).mean_error, 0);
  EXPECT_EQ(picture_difference(a, b).overlap, 1);
  for (Raster* raster : {&a, &b})
    for (int i = 0; i < 64; ++i) set(*raster, i % 8, i / 8, raster == &a ? 0 : 255, 0);
  EXPECT_EQ(picture_difference(a, b).changed, 0);  // two empty pictures
}

// Laws: nothing differs from itself; the order does not matter; SSIM is at most 1.
TEST(PictureDifference, IsSymmetric) {
  for (unsigned seed = 1; seed < 5; ++seed) {
    const Raster a = noise(24, seed), b = noise(24, seed + 10);
    const PictureDifference one = picture_difference(a, b), other = picture_difference(b, a),
                            none = picture_difference(a, a);
    EXPECT_EQ(one.changed, other.changed);
    EXPECT_NEAR(one.mean_error, other.mean_error, kRounding);
    EXPECT_NEAR(one.ssim, other.ssim, kRounding);
    EXPECT_EQ(one.overlap, other.overlap);
    EXPECT_LT(one.ssim, 0.5);
    EXPECT_EQ(none.changed + none.mean_error, 0);
    EXPECT_EQ(none.ssim * none.overlap, 1);
  }
}

// A is white, B black: what differs is drawn in the last heat colour.
TEST(PictureDifference, IsDrawnBesideBoth) {
  const Raster a = flat(32, 255), b = flat(32, 0), shown = picture_of_difference(a, b, "x");
  EXPECT_EQ(shown.height, 32 + 2 * 2);
  EXPECT_EQ(shown.width, 3 * 32 + 4 * 2);
  EXPECT_EQ(pixel(shown, 30, 30)[1], 255);
  EXPECT_EQ(pixel(shown, 60, 30)[1], 0);
  const auto heat = pixel(shown, 95, 30), same = pixel(picture_of_difference(a, a, "x"), 95, 30);
  EXPECT_GT(heat[0], heat[2] + 50);
  EXPECT_EQ(same[0], same[2]);
  EXPECT_GT(same[0], 200);
}

// By hand: the square is 64 / (d tan(fov / 2)) pixels wide at a distance d.
TEST(Draw, AlphaIsCoverage) {
  PolygonMesh mesh = empty_mesh();
  add_square(mesh, 1, 0);
  const std::vector<Material> materials{unlit(Vec4(1, 0, 0, 1))};
  const View view = fit_view(Vec3::Zero(), 4, {});
  const auto coverage = [&](bool is_asked_for) {
    const Raster raster = draw(Subject(mesh, materials), {}, view,
                               {.width = 64, .height = 64, .alpha_is_coverage = is_asked_for});
    double sum = 0;
    for (std::size_t i = 3; i < raster.rgba.size(); i += 4) sum += raster.rgba[i] / 255.0;
    return sum;
  };
  EXPECT_EQ(coverage(false), 64 * 64);
  const double across = 64 / (view.eye.norm() * std::tan(view.fov / 2));
  EXPECT_NEAR(coverage(true), across * across, 4 * across / 16);  // each rim pixel to a sample
}

}  // namespace
}  // namespace skinforge
