#include "surface/quad_cap.h"

#include <gtest/gtest.h>

#include "surface/shapes.h"

namespace skinforge {
namespace {

// The top of a cylinder about the y axis, which goes on below.
JunctionLoop cylinder_top(int count) {
  JunctionLoop loop{SourceId(0), true, {}, testing::ring(count), {}};
  for (const Vec3& p : loop.positions) loop.inward.push_back({p - Vec3(0, 0.3, 0)});
  return loop;
}

TEST(CapFaces, ByHand) {
  const QuadPatch even = cap_faces(8, 3, 2, 2, false);
  EXPECT_EQ(even.quads.size(), 4u);
  EXPECT_EQ(even.positions.size(), 9u);
  EXPECT_EQ(even.quads[0], (Quad{3, 4, 8, 2}));
  const QuadPatch odd = cap_faces(9, 0, 3, 1, true);
  EXPECT_EQ(odd.quads.size(), 8u + 3);
  EXPECT_EQ(odd.triangles.size(), 1u);
  EXPECT_EQ(odd.positions.size(), 9u + 8);
}

class CapCounts : public ::testing::TestWithParam<int> {};

// Law: one closed disc with the border as it was, one triangle when the border is odd.
TEST_P(CapCounts, AnyBorderIsClosed) {
  const int n = GetParam();
  const JunctionLoop loop = cylinder_top(n);
  const auto cap = quad_cap(loop);
  if (n < 4) {
    EXPECT_FALSE(cap);
    return;
  }
  ASSERT_TRUE(cap);
  EXPECT_EQ(cap->triangles.size(), static_cast<std::size_t>(n % 2));
  EXPECT_EQ(cap->fixed, static_cast<std::size_t>(n));
  for (int k = 0; k < n; ++k) EXPECT_EQ(cap->positions[k], loop.positions[k]);
  const TrianglePatch halves = halved(*cap);
  for (const auto& [edge, uses] : testing::half_edge_uses(halves.triangles)) EXPECT_EQ(uses, 1);
  const auto loops = boundary_loops(halves.triangles);
  ASSERT_EQ(loops.size(), 1u);
  EXPECT_EQ(loops[0].size(), static_cast<std::size_t>(n));
  const MeshTopology topology = testing::topology_of(halves);
  EXPECT_EQ(topology.euler, 1);
  EXPECT_EQ(topology.non_manifold_vertices, 0u);
  EXPECT_GE(least_scaled_jacobian(*cap), 0.2);
}

INSTANTIATE_TEST_SUITE_P(From3To60, CapCounts, ::testing::Range(3, 61));

}  // namespace
}  // namespace skinforge
