#include "surface/cut_line.h"

#include <gtest/gtest.h>

#include "surface/shapes.h"

namespace skinforge {
namespace {

constexpr double kRounding = 1e-12;

// Presence falls along x and is 1/2 at x = `at`.
std::vector<double> falling_presence(const PolygonMesh& mesh, double at) {
  std::vector<double> presence;
  for (const Vec3& p : mesh.positions) presence.push_back(std::clamp(0.5 - (p.x() - at) / 4, 0., 1.));
  return presence;
}

// By hand: a regular 8-gon of radius 2 about (2.3, 0, 0), 8 * 4 * sin(pi / 8) around.
TEST(LongestCutLine, AroundATube) {
  const PolygonMesh tube = testing::open_tube(6, 8, 0, 1, 2);
  const auto line = longest_cut_line(tube, falling_presence(tube, 2.3));
  ASSERT_TRUE(line);
  EXPECT_NEAR(line->length, 32 * std::sin(std::numbers::pi / 8), kRounding);
  EXPECT_LT((line->centre - Vec3(2.3, 0, 0)).norm(), kRounding);
}

// Of two tubes side by side the thicker has the longer line.
TEST(LongestCutLine, TheLongestPieceCounts) {
  PolygonMesh thick = testing::open_tube(6, 8, 0, 1, 1);
  for (Vec3& p : thick.positions) p.y() += 10;
  const PolygonMesh both = testing::joined(testing::open_tube(6, 8, 0, 1, 0.5), thick);
  const auto line = longest_cut_line(both, falling_presence(both, 2.5));
  ASSERT_TRUE(line);
  EXPECT_NEAR(line->centre.y(), 10, kRounding);
  EXPECT_NEAR(line->length, 16 * std::sin(std::numbers::pi / 8), kRounding);
}

TEST(LongestCutLine, NoneWhereNothingCrosses) {
  const PolygonMesh tube = testing::open_tube(6, 8, 0, 1, 2);
  EXPECT_FALSE(longest_cut_line(tube, std::vector<double>(48, 1)));
  EXPECT_FALSE(longest_cut_line(tube, std::vector<double>(48, 0)));
  EXPECT_FALSE(longest_cut_line({}, {}));
}

}  // namespace
}  // namespace skinforge
