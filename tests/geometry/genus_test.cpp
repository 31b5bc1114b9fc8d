#include "geometry/genus.h"

#include <gtest/gtest.h>

#include "testing/shapes.h"

namespace skinforge {
namespace {
using testing::Soup;

TEST(Genus, OfClosedSurfaces) {
  const SurfaceGenus cube = measure_genus(testing::polygon_mesh(testing::cube_soup()));
  EXPECT_EQ(cube.handles, 0U);
  EXPECT_EQ(cube.closed, 1U);
  EXPECT_EQ(cube.open + cube.boundary_loops + cube.non_manifold, 0U);
  const SurfaceGenus ring = measure_genus(testing::polygon_mesh(testing::torus_knot_soup(40, 7)));
  EXPECT_EQ(ring.handles, 1U);
  EXPECT_EQ(ring.closed, 1U);
}

// Two rings, a triangle cut out of each, are sewn together at its border: a ring with two holes.
TEST(Genus, OfTwoRingsInOne) {
  const Soup one = testing::torus_knot_soup(12, 5);
  const auto hole = one.triangles.back();
  const auto shift = static_cast<std::int32_t>(one.positions.size());
  Soup both = one;
  both.triangles.pop_back();
  both.positions.insert(both.positions.end(), one.positions.begin(), one.positions.end());
  for (std::size_t t = 0; t + 1 < one.triangles.size(); ++t) {
    std::array<std::int32_t, 3> sewn{};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto at = std::find(hole.begin(), hole.end(), one.triangles[t][i]);
      sewn[i] = at == hole.end() ? one.triangles[t][i] + shift : hole[std::size_t(hole.end() - at) % 3];
    }
    both.triangles.push_back(sewn);
  }
  const SurfaceGenus genus = measure_genus(testing::polygon_mesh(both));
  EXPECT_EQ(genus.non_manifold, 0U);
  EXPECT_EQ(genus.closed, 1U);
  EXPECT_EQ(genus.handles, 2U);
}

// By hand: a strip has one border, a tube two, a ring without one of its triangles one.
TEST(Genus, OfOpenSurfaces) {
  const std::vector<Vec3> p(8, Vec3::Zero());
  const SurfaceGenus strip = measure_genus(testing::polygon_mesh(p, {{0, 1, 4, 3}, {1, 2, 5, 4}}));
  EXPECT_EQ(strip.boundary_loops, 1U);
  EXPECT_EQ(strip.handles + strip.closed, 0U);
  const SurfaceGenus tube =
      measure_genus(testing::polygon_mesh(p, {{0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}));
  EXPECT_EQ(tube.boundary_loops, 2U);
  EXPECT_EQ(tube.open, 1U);
  EXPECT_EQ(tube.handles, 0U);
  Soup ring = testing::torus_knot_soup(12, 5);
  ring.triangles.erase(ring.triangles.begin() + 7);
  const SurfaceGenus cut = measure_genus(testing::polygon_mesh(ring));
  EXPECT_EQ(cut.boundary_loops, 1U);
  EXPECT_EQ(cut.handles, 1U);
}

// Two triangles that touch at a vertex are two discs; three at an edge are no surface.
TEST(Genus, OfWhatIsNoSurface) {
  const std::vector<Vec3> p(7, Vec3::Zero());
  const SurfaceGenus bow_tie = measure_genus(testing::polygon_mesh(p, {{0, 1, 2}, {0, 3, 4}}));
  EXPECT_EQ(bow_tie.open, 2U);
  EXPECT_EQ(bow_tie.boundary_loops, 2U);
  const SurfaceGenus fins = measure_genus(testing::polygon_mesh(p, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}));
  EXPECT_EQ(fins.non_manifold, 1U);
  EXPECT_EQ(fins.open + fins.closed + fins.handles + fins.boundary_loops, 0U);
  EXPECT_EQ(measure_genus(testing::polygon_mesh(p, {{0, 1, 2}, {0, 1, 4}})).non_manifold, 1U);
  EXPECT_EQ(measure_genus(PolygonMesh()).closed, 0U);
}

// Law: a vertex twice in a row is one vertex.
TEST(Genus, IgnoresEdgesWithoutLength) {
  const std::vector<Vec3> p(8, Vec3::Zero());
  const SurfaceGenus tube =
      measure_genus(testing::polygon_mesh(p, {{0, 1, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 7, 6}, {3, 0, 4, 7}}));
  EXPECT_EQ(tube.boundary_loops, 2U);
  EXPECT_EQ(tube.handles + tube.non_manifold, 0U);
}

}  // namespace
}  // namespace skinforge
