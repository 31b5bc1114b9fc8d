#include "geometry/self_intersection.h"

#include <gtest/gtest.h>

#include "testing/shapes.h"

namespace skinforge {
namespace {

using testing::Soup;
constexpr double kExact = 1e-12;

const std::vector<Vec3> kPoints = {{0, 0, 0},   {4, 0, 0},     {0, 4, 0},  // 0 1 2: the floor
                                   {1, 1, -1},  {1, 1, 1},     {9, 9, 1},  // 3 4 5: stands through it
                                   {1, 1, 0.5}, {2, 1, 0.5},   {1, 2, 2},  // 6 7 8: hovers above
                                   {1, 1, 0},   {1, 1, 3},     {2, 1, 3},  // 9 10 11: touches with a corner
                                   {4, 4, 0},   {0.5, 0.5, 0},  // 12: beyond the edge 1-2; 13: before it
                                   {3, 1, 2},   {3, 1, -2}};

bool cut(const std::array<std::int32_t, 3>& a, const std::array<std::int32_t, 3>& b) {
  const bool there = triangles_intersect(kPoints, a, b, kExact),
             back = triangles_intersect(kPoints, b, a, kExact);
  EXPECT_EQ(there, back);
  return there;
}

TEST(TrianglesIntersect, ByHand) {
  EXPECT_TRUE(cut({0, 1, 2}, {3, 4, 5}));
  EXPECT_FALSE(cut({0, 1, 2}, {6, 7, 8}));
  EXPECT_FALSE(cut({0, 1, 2}, {9, 10, 11}));  // touching
  EXPECT_FALSE(cut({0, 1, 2}, {0, 1, 2}));    // itself
  EXPECT_FALSE(cut({0, 1, 2}, {3, 3, 4}));    // degenerate
}

TEST(TrianglesIntersect, SharedEdge) {
  EXPECT_FALSE(cut({0, 1, 2}, {2, 1, 12}));  // flat neighbours
  EXPECT_FALSE(cut({0, 1, 2}, {2, 1, 8}));   // a ridge
  EXPECT_TRUE(cut({0, 1, 2}, {2, 1, 13}));   // folded back onto the floor
}

TEST(TrianglesIntersect, SharedCorner) {
  EXPECT_FALSE(cut({0, 1, 2}, {0, 6, 10}));   // rises from corner 0
  EXPECT_TRUE(cut({0, 1, 2}, {0, 3, 4}));     // from corner 0, its far edge passes through the floor
  EXPECT_FALSE(cut({0, 1, 2}, {1, 14, 15}));  // its far edge meets the floor on the side 1-2 itself
}

Soup two_spheres(double apart) {
  Soup both = testing::sphere_soup(10);
  const Soup second = testing::sphere_soup(10, 1, Vec3(apart, 0.013, 0.007));
  const int shift = static_cast<int>(both.positions.size());
  both.positions.insert(both.positions.end(), second.positions.begin(), second.positions.end());
  for (const auto& t : second.triangles) both.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
  return both;
}

TEST(SelfIntersections, ClosedSurfacesHaveNone) {
  for (const Soup& s :
       {testing::cube_soup(), testing::sphere_soup(12), testing::torus_knot_soup(80, 10), two_spheres(2.2)})
    EXPECT_EQ(count_self_intersections(s.positions, s.triangles), 0u);
}

// Two spheres a radius apart: every pair joins one triangle of each, and all lie near the common circle x =
// 1/2.
TEST(SelfIntersections, CrossingSpheres) {
  const Soup s = two_spheres(1);
  const auto pairs = self_intersections(s.positions, s.triangles);
  EXPECT_GT(pairs.size(), 20u);
  const auto half = static_cast<std::int32_t>(s.triangles.size() / 2);
  for (const auto& [a, b] : pairs) {
    EXPECT_LT(a, half);
    EXPECT_GE(b, half);
    EXPECT_NEAR(s.positions[s.triangles[a][0]].x(), 0.5, 0.4);
  }
}

TEST(SelfIntersections, MatchBruteForceAndSubsetsSplitThem) {
  std::mt19937 random(3);
  const Soup s = testing::random_soup(random, 60);
  const auto all = self_intersections(s.positions, s.triangles);
  std::vector<std::pair<std::int32_t, std::int32_t>> expected;
  for (std::int32_t a = 0; a < 60; ++a)
    for (std::int32_t b = a + 1; b < 60; ++b)
      if (triangles_intersect(s.positions, s.triangles[a], s.triangles[b], kExact))
        expected.emplace_back(a, b);
  EXPECT_EQ(all, expected);
  std::vector<std::uint8_t> subset(60, 0);
  for (int i = 0; i < 20; ++i) subset[i] = 1;
  std::erase_if(expected, [](const auto& pair) { return pair.first >= 20; });
  EXPECT_EQ(self_intersections(s.positions, s.triangles, {subset}), expected);
  std::vector<std::int32_t> groups(60, 0);  // 0 to 29 are one group, 30 to 59 none
  for (std::size_t i = 30; i < groups.size(); ++i) groups[i] = -1;
  std::erase_if(expected, [](const auto& pair) { return pair.second < 30; });
  EXPECT_EQ(self_intersections(s.positions, s.triangles, {subset, groups}), expected);
}

TEST(SelfIntersections, Empty) {
  EXPECT_EQ(count_self_intersections({}, {}), 0u);
}

}  // namespace
}  // namespace skinforge
