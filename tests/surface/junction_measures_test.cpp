#include "surface/junction_measures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "surface/two_cubes.h"
#include "testing/fields.h"

namespace skinforge {
namespace {

using ::testing::DoubleNear;
using ::testing::Each;
using testing::TwoCubes;

constexpr double kRounding = 1e-12;

// The box of 1 x 1 x 3 by hand: four square walls in the planes of their neighbours, no new vertex.
TEST(MeasureJunction, SquareWalls) {
  const TwoCubes cubes;
  const JunctionMeasures m = measure_junction(cubes.joined(cubes.walls()), 0, nullptr);
  EXPECT_EQ(m.faces, 4u);
  EXPECT_EQ(m.quads, 4u);
  EXPECT_EQ(m.triangles, 0u);
  EXPECT_EQ(m.components, 1u);
  EXPECT_EQ(m.boundary_edges + m.non_manifold_edges + m.degenerate_faces, 0u);
  EXPECT_EQ(m.self_intersections + m.folded_faces + m.irregular_vertices, 0u);
  EXPECT_EQ(m.scaled_jacobian.size(), 4u);
  EXPECT_THAT(m.scaled_jacobian, Each(DoubleNear(1, kRounding)));
  EXPECT_EQ(m.border_dihedral.size(), 8u);
  EXPECT_THAT(m.border_dihedral, Each(DoubleNear(0, 1e-7)));  // acos near 1
  EXPECT_TRUE(m.deviation.empty());
  EXPECT_TRUE(m.edge_length_ratio.empty());
}

// Halved walls: four new vertices of valence 4, and at each of the eight border edges new edges of half its
// length.
TEST(MeasureJunction, HalvedWalls) {
  const TwoCubes cubes;
  const JunctionMeasures m = measure_junction(cubes.joined(cubes.halved_walls()), 0, nullptr);
  EXPECT_EQ(m.quads, 8u);
  EXPECT_EQ(m.irregular_vertices, 0u);
  EXPECT_EQ(m.edge_length_ratio.size(), 8u);
  EXPECT_THAT(m.edge_length_ratio, Each(DoubleNear(0.5, kRounding)));
}

// A field of 0.1 everywhere is 0.2 voxels of 0.5 away, at 4 new vertices and 8 face centres.
TEST(MeasureJunction, DeviationFromTheField) {
  const TwoCubes cubes;
  const auto field = testing::sampled(testing::centred_lattice(17, 4), [](const Vec3&) { return 0.1; });
  const JunctionMeasures m = measure_junction(cubes.joined(cubes.halved_walls()), 0, &field);
  EXPECT_EQ(m.deviation.size(), 12u);
  EXPECT_THAT(m.deviation, Each(DoubleNear(0.2, 1e-7)));  // floats
  EXPECT_EQ(m.folded_faces, 0u);
}

// Where the field rises inwards, every face looks the wrong way.
TEST(MeasureJunction, FoldedFaces) {
  const TwoCubes cubes;
  const auto radius = [](const Vec3& p) { return std::hypot(p.x() - 0.5, p.y() - 0.5); };
  const auto outward = testing::sampled(testing::centred_lattice(33, 4), radius);
  const auto inward =
      testing::sampled(testing::centred_lattice(33, 4), [&](const Vec3& p) { return -radius(p); });
  EXPECT_EQ(measure_junction(cubes.joined(cubes.walls()), 0, &outward).folded_faces, 0u);
  EXPECT_EQ(measure_junction(cubes.joined(cubes.walls()), 0, &inward).folded_faces, 4u);
}

// One wall is missing: two of its edges are open at the junction, the two others at the cubes, which have
// theirs from the cut.
TEST(MeasureJunction, MissingWall) {
  const TwoCubes cubes;
  TrianglePatch patch = cubes.walls();
  patch.triangles.resize(6);
  const JoinedSurface joined = cubes.joined(patch);
  const JunctionMeasures m = measure_junction(joined, 0, nullptr);
  EXPECT_EQ(m.boundary_edges, 2u);
  EXPECT_EQ(inherited_edges(joined).open, 2u);
  EXPECT_EQ(inherited_edges(joined).non_manifold, 0u);
}

TEST(InheritedEdges, OpenBordersOfTheInputs) {
  const TwoCubes cubes;
  EXPECT_EQ(inherited_edges(cubes.joined({})).open, 8u);
  EXPECT_EQ(inherited_edges(cubes.joined(cubes.walls())).open, 0u);
}

}  // namespace
}  // namespace skinforge
