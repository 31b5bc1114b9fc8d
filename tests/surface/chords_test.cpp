#include "surface/chords.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "surface/ring_zip.h"
#include "surface/shapes.h"

namespace skinforge {
namespace {

using ::testing::ElementsAre;

constexpr double kRounding = 1e-12;  // sums of a few dozen areas

TrianglePatch filled(const std::vector<Vec3>& loop) {
  return {loop, fill_loop(loop), loop.size()};
}

// A square of two triangles: its diagonal gets the centre, which makes four.
TEST(SplitChords, DiagonalOfASquare) {
  const TrianglePatch square{{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}, {{0, 1, 2}, {0, 2, 3}}, 4};
  const TrianglePatch split = split_chords(square);
  ASSERT_EQ(split.positions.size(), 5u);
  EXPECT_EQ(split.positions[4], Vec3(1, 1, 0));
  EXPECT_EQ(split.fixed, 4u);
  EXPECT_THAT(boundary_loops(split.triangles), ElementsAre(ElementsAre(0, 1, 2, 3)));
  EXPECT_EQ(split.triangles.size(), 4u);
  for (const Triangle& t : split.triangles) EXPECT_NE(std::find(t.begin(), t.end(), 4), t.end());
}

// Spokes to a free centre are no chords.
TEST(SplitChords, LeavesAFanAlone) {
  const TrianglePatch fan{{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {1, 1, 0}},
                          {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}},
                          4};
  EXPECT_EQ(split_chords(fan).triangles, fan.triangles);
}

// Law: a polygon of n corners filled without new vertices has n - 3 chords, up to three at one triangle.
TEST(SplitChords, NoneLeftAreaAndBorderKept) {
  for (const int n : {4, 5, 6, 9, 12, 31}) {
    const TrianglePatch polygon = filled(testing::ring(n));
    ASSERT_EQ(testing::chord_count(polygon), n - 3);
    const TrianglePatch split = split_chords(polygon);
    EXPECT_EQ(testing::chord_count(split), 0) << n;
    EXPECT_EQ(split.positions.size(), static_cast<std::size_t>(n + n - 3));
    EXPECT_EQ(split.triangles.size(), static_cast<std::size_t>(n - 2 + 2 * (n - 3)));
    EXPECT_NEAR(testing::area_of(split), testing::area_of(polygon), kRounding);
    EXPECT_EQ(boundary_loops(split.triangles), boundary_loops(polygon.triangles));
    const MeshTopology topology = testing::topology_of(split);
    EXPECT_EQ(topology.non_manifold_edges + topology.non_manifold_vertices, 0u);
    EXPECT_EQ(topology.euler, 1);
  }
}

TEST(SplitChords, EmptyPatch) {
  EXPECT_TRUE(split_chords({}).triangles.empty());
}

}  // namespace
}  // namespace skinforge
