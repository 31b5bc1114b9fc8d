#include "surface/triangle_patch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "surface/shapes.h"

namespace skinforge {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using Triangles = std::vector<Triangle>;

// Four triangles about vertex 4: the border runs 0, 1, 2, 3 as they do.
TEST(BoundaryLoops, OfAFan) {
  const Triangles fan = {{2, 3, 4}, {0, 1, 4}, {3, 0, 4}, {1, 2, 4}};
  EXPECT_THAT(boundary_loops(fan), ElementsAre(ElementsAre(0, 1, 2, 3)));
}

TEST(BoundaryLoops, NoneWhereClosedOrEmpty) {
  EXPECT_THAT(boundary_loops(testing::cube_soup().triangles), IsEmpty());
  EXPECT_THAT(boundary_loops({}), IsEmpty());
}

// Two triangles that meet in vertex 0 alone: two fans, two loops.
TEST(BoundaryLoops, PinchBetweenTwoPieces) {
  EXPECT_THAT(boundary_loops(Triangles{{0, 1, 2}, {0, 3, 4}}),
              ElementsAre(ElementsAre(0, 1, 2), ElementsAre(0, 3, 4)));
}

// A strip of four triangles bent round until its ends touch in vertex 0: one loop that passes 0 once per end.
TEST(BoundaryLoops, PinchOfAStripWithItself) {
  const Triangles strip = {{0, 1, 2}, {1, 3, 2}, {3, 4, 2}, {3, 0, 4}};
  EXPECT_THAT(boundary_loops(strip), ElementsAre(ElementsAre(0, 1, 3, 0, 4, 2)));
}

// Law: on a sphere with random holes, loops run once along each half-edge without a partner and along no
// other.
TEST(BoundaryLoops, UseEachOpenHalfEdgeOnce) {
  std::mt19937 random(3);
  const auto sphere = testing::sphere_soup(12);
  Triangles kept;
  for (const Triangle& t : sphere.triangles)
    if (random() % 4 != 0) kept.push_back(t);
  const auto uses = testing::half_edge_uses(kept);
  std::set<std::pair<std::int32_t, std::int32_t>> open, walked;
  for (const auto& [edge, number] : uses)
    if (!uses.contains({edge.second, edge.first})) open.insert(edge);
  std::size_t steps = 0;
  std::int32_t first = -1;
  for (const auto& loop : boundary_loops(kept)) {
    EXPECT_EQ(loop.front(), *std::min_element(loop.begin(), loop.end()));
    EXPECT_GE(loop.front(), first);
    first = loop.front();
    for (std::size_t i = 0; i < loop.size(); ++i, ++steps)
      walked.insert({loop[i], loop[(i + 1) % loop.size()]});
  }
  EXPECT_EQ(walked, open);
  EXPECT_EQ(steps, open.size());
}

// A shared vertex joins; numbers go by the lowest triangle.
TEST(TriangleComponents, BySharedVertices) {
  const auto [component, count] = triangle_components(Triangles{{0, 1, 2}, {3, 4, 5}, {2, 6, 7}}, 9);
  EXPECT_THAT(component, ElementsAre(0, 1, 0));
  EXPECT_EQ(count, 2);
  EXPECT_EQ(triangle_components({}, 4).second, 0);
}

// Of the fixed vertices 0, 1 and the free ones 2 .. 5, the triangle uses 1, 3, 5: only 2 and 4 go.
TEST(WithoutUnusedVertices, FixedOnesStay) {
  TrianglePatch patch{{}, {{1, 5, 3}}, 2};
  for (int v = 0; v < 6; ++v) patch.positions.emplace_back(v, 0, 0);
  const TrianglePatch result = without_unused_vertices(patch);
  EXPECT_EQ(result.fixed, 2u);
  EXPECT_THAT(result.positions, ElementsAre(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(3, 0, 0), Vec3(5, 0, 0)));
  EXPECT_THAT(result.triangles, ElementsAre(Triangle{1, 3, 2}));
}

TEST(LoopLength, ClosesTheLoop) {
  EXPECT_EQ(loop_length(std::vector<Vec3>{{0, 0, 0}, {3, 0, 0}, {3, 4, 0}}), 12);
  EXPECT_EQ(loop_length({}), 0);
}

}  // namespace
}  // namespace skinforge
