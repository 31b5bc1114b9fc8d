#include "texture/texel_map.h"

#include <gtest/gtest.h>

namespace skinforge {
namespace {

constexpr double kRounding = 1e-12;  // a few products in double

// By hand: a right triangle with legs of 4 texels from the corner (2.5, 2.5). The texel with its centre there
// shows corner 0, two to the right the middle of the leg; two above it still the corner (gutter), three above
// nothing.
TEST(MapTexels, InsideRimAndNothing) {
  const std::vector<std::array<Vec2, 3>> triangles = {{Vec2(2.5, 2.5), Vec2(6.5, 2.5), Vec2(2.5, 6.5)}};
  const auto map = map_texels(triangles, 16, 16, 2);
  const auto at = [&](int x, int y) { return map[static_cast<std::size_t>(y) * 16 + x]; };
  EXPECT_LT((at(2, 2).barycentric - Vec3(1, 0, 0)).norm(), kRounding);
  EXPECT_LT((at(4, 2).barycentric - Vec3(0.5, 0.5, 0)).norm(), kRounding);
  EXPECT_LT((at(3, 3).barycentric - Vec3(0.5, 0.25, 0.25)).norm(), kRounding);
  EXPECT_EQ(at(2, 0).triangle, 0);
  EXPECT_LT((at(2, 0).barycentric - Vec3(1, 0, 0)).norm(), kRounding);
  EXPECT_EQ(at(12, 12).triangle, -1);
  EXPECT_EQ(at(2, 9).triangle, -1);
}

TEST(MapTexels, NearerTriangleWinsAndDegenerateOnesCount) {
  const std::vector<std::array<Vec2, 3>> triangles = {{Vec2(2.5, 2.5), Vec2(2.5, 2.5), Vec2(2.5, 2.5)},
                                                      {Vec2(6.5, 0.5), Vec2(9.5, 0.5), Vec2(6.5, 5.5)}};
  const auto map = map_texels(triangles, 16, 8, 4);
  EXPECT_EQ(map[2 * 16 + 3].triangle, 0);
  EXPECT_EQ(map[2 * 16 + 5].triangle, 1);
}

// By hand: three known texels of four in one square leave their mean in the fourth; a far square takes the
// mean of all.
TEST(FillUnset, TakesTheMeanOfItsSurroundings) {
  Raster raster{4, 4, std::vector<std::uint8_t>(64, 255)};
  std::vector<bool> is_set(16, false);
  const auto set = [&](int x, int y, std::uint8_t value) {
    is_set[static_cast<std::size_t>(y) * 4 + x] = true;
    for (int c = 0; c < 3; ++c) raster.rgba[4 * (static_cast<std::size_t>(y) * 4 + x) + c] = value;
  };
  set(0, 0, 30);
  set(1, 0, 60);
  set(0, 1, 90);
  fill_unset(raster, is_set);
  EXPECT_EQ(raster.rgba[4 * (4 + 1)], 60);      // (30 + 60 + 90) / 3
  EXPECT_EQ(raster.rgba[4 * (3 * 4 + 3)], 60);  // the only known quarter
  EXPECT_EQ(raster.rgba[0], 30) << "known texels stay";
}

// A row of eight: the known left end fills all of it.
TEST(FillUnset, WorksOnStrips) {
  Raster raster{8, 1, std::vector<std::uint8_t>(32, 255)};
  raster.rgba[0] = 9;
  std::vector<bool> is_set(8, false);
  is_set[0] = true;
  fill_unset(raster, is_set);
  for (int x = 0; x < 8; ++x) EXPECT_EQ(raster.rgba[4 * x], 9);
}

TEST(FillUnset, NothingKnownIsWhite) {
  Raster raster{2, 2, std::vector<std::uint8_t>(16, 7)};
  fill_unset(raster, std::vector<bool>(4, false));
  EXPECT_EQ(raster.rgba, std::vector<std::uint8_t>(16, 255));
}

}  // namespace
}  // namespace skinforge
