#include "texture/pack_charts.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "texture/tube_mesh.h"

namespace skinforge {
namespace {

using testing::all_faces;
using testing::tube_mesh;

constexpr double kRounding = 1e-9;  // texel coordinates near 100

// Boxes with their gutters never overlap, all lie inside.
TEST(PackCharts, BoxesAreApartAndInside) {
  const PolygonMesh mesh = tube_mesh(6, 12, 0, 0.3, 1);
  const auto charts = grow_charts(mesh, all_faces(mesh), {.max_turn_deg = 20});
  const PackingOptions options{.texels_per_metre = 60};
  const auto packing = pack_charts(charts, options);
  EXPECT_GE(packing.texels_per_metre, 0.85 * options.texels_per_metre);
  for (std::size_t a = 0; a < charts.size(); ++a) {
    const Vec2 low = packing.origin[a], high = low + packing.texels_per_metre * charts[a].size;
    EXPECT_GE(low.minCoeff(), options.gutter);
    EXPECT_LE(high.x(), packing.width - options.gutter);
    EXPECT_LE(high.y(), packing.height - options.gutter);
    for (std::size_t b = 0; b < a; ++b) {
      const Vec2 other_low = packing.origin[b];
      const Vec2 other_high = other_low + packing.texels_per_metre * charts[b].size;
      const Vec2 gap = (other_low - high).cwiseMax(low - other_high);
      EXPECT_GE(gap.maxCoeff(), 2 * options.gutter - kRounding);
    }
  }
}

TEST(PackCharts, FallsBackToALowerDensity) {
  const PolygonMesh mesh = testing::flat_grid(2, 2);
  const auto charts = grow_charts(mesh, all_faces(mesh));
  const auto packing = pack_charts(charts, {.texels_per_metre = 1e5});
  EXPECT_EQ(packing.width, 1024);
  EXPECT_EQ(packing.height, 1024);
  EXPECT_LT(packing.texels_per_metre, 512);
  EXPECT_GT(packing.texels_per_metre, 400);
}

// By hand: 8 x 1 metres at 30 texels a metre are 245 x 35 texels with gutters: 256 wide, and 64 rows are
// enough.
TEST(PackCharts, CutsOffTheEmptyHalf) {
  const PolygonMesh mesh = testing::flat_grid(1, 8);
  const auto packing = pack_charts(grow_charts(mesh, all_faces(mesh)), {.texels_per_metre = 30});
  EXPECT_EQ(packing.width, 256);
  EXPECT_EQ(packing.height, 64);
  EXPECT_EQ(packing.texels_per_metre, 30);
}

// By hand: at 31.5 texels a metre they would be 257 wide; 5 % less is taken rather than 512.
TEST(PackCharts, TakesALittleLessRatherThanTwiceTheWidth) {
  const PolygonMesh mesh = testing::flat_grid(1, 8);
  const auto packing = pack_charts(grow_charts(mesh, all_faces(mesh)), {.texels_per_metre = 31.5});
  EXPECT_EQ(packing.width, 256);
  EXPECT_NEAR(packing.texels_per_metre, 30, kRounding);
}

TEST(PackCharts, TooManyGuttersIsAnError) {
  const PolygonMesh mesh = testing::flat_grid(20, 20);
  const auto charts = grow_charts(mesh, all_faces(mesh), {.max_turn_deg = 0});
  EXPECT_THROW(pack_charts(charts, {.texels_per_metre = 10, .smallest = 64, .largest = 64}), Error);
}

}  // namespace
}  // namespace skinforge
