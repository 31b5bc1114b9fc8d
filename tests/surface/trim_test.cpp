#include "surface/trim.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "surface/shapes.h"

namespace skinforge {
namespace {

const IsoSurface kTriangle{{{0, 0, 0}, {10, 0, 0}, {0, 10, 0}}, {{0, 1, 2}}};

// One corner is positive: what stays reaches half way to the others.
TEST(TrimPositive, KeepsACorner) {
  const TrianglePatch patch = trim_positive(kTriangle, std::vector<double>{1, -1, -1});
  EXPECT_THAT(patch.positions, ::testing::ElementsAre(Vec3(0, 0, 0), Vec3(5, 0, 0), Vec3(0, 5, 0)));
  EXPECT_THAT(patch.triangles, ::testing::ElementsAre(Triangle{0, 1, 2}));
  EXPECT_EQ(patch.fixed, 0u);
}

// Two corners are positive: the small triangle at the other goes, 1/4 * 3/4 of the edges long.
TEST(TrimPositive, CutsACornerOff) {
  const TrianglePatch patch = trim_positive(kTriangle, std::vector<double>{-1, 3, 1});
  EXPECT_EQ(patch.triangles.size(), 2u);
  EXPECT_DOUBLE_EQ(testing::area_of(patch), 50 - 0.5 * 2.5 * 5);
  EXPECT_EQ(testing::topology_of(patch).euler, 1);
}

// Nearly nothing is positive: the cut stays a tenth of the edge away from its end.
TEST(TrimPositive, NoSlivers) {
  const TrianglePatch patch = trim_positive(kTriangle, std::vector<double>{1e-6, -1, -1});
  ASSERT_EQ(patch.positions.size(), 3u);
  EXPECT_EQ(patch.positions[1], Vec3(1, 0, 0));
  EXPECT_EQ(patch.positions[2], Vec3(0, 1, 0));
}

TEST(TrimPositive, AllOrNothing) {
  EXPECT_EQ(trim_positive(kTriangle, std::vector<double>{1, 1, 1}).triangles, kTriangle.triangles);
  EXPECT_TRUE(trim_positive(kTriangle, std::vector<double>{0, 0, 0}).triangles.empty());
  EXPECT_TRUE(trim_positive({}, {}).positions.empty());
}

// A sphere cut by a plane is a disc with one border; nothing reaches further below the plane than a tenth of
// the edge that it cuts.
TEST(TrimPositive, SphereCutByAPlane) {
  const auto sphere = testing::sphere_soup(16);
  std::vector<double> height;
  for (const Vec3& p : sphere.positions) height.push_back(p.y() + 0.1 * p.x() - 0.13);
  const TrianglePatch patch = trim_positive({sphere.positions, sphere.triangles}, height);
  const MeshTopology topology = testing::topology_of(patch);
  EXPECT_EQ(topology.euler, 1);
  EXPECT_EQ(topology.non_manifold_edges + topology.non_manifold_vertices, 0u);
  EXPECT_EQ(topology.vertices, patch.positions.size());
  const auto loops = boundary_loops(patch.triangles);
  ASSERT_EQ(loops.size(), 1u);
  const double longest = 1.5 * std::numbers::pi / 16;  // diagonal of a cell of the sphere, rounded up
  for (const Vec3& p : patch.positions) EXPECT_GT(p.y() + 0.1 * p.x() - 0.13, -0.1 * longest);
  for (const std::int32_t v : loops[0]) {
    const Vec3& p = patch.positions[v];
    EXPECT_NEAR(p.y() + 0.1 * p.x(), 0.13, 0.1 * longest);
  }
}

}  // namespace
}  // namespace skinforge
