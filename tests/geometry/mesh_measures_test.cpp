#include "geometry/mesh_measures.h"

#include <gtest/gtest.h>

#include <cmath>

#include "testing/shapes.h"

namespace skinforge {
namespace {

TEST(MeasureTopology, ClosedShapes) {
  const MeshTopology cube = measure_topology(testing::polygon_mesh(testing::cube_soup()));
  EXPECT_EQ(cube.vertices, 8u);
  EXPECT_EQ(cube.edges, 18u);
  EXPECT_EQ(cube.faces, 12u);
  EXPECT_EQ(cube.triangles, 12u);
  EXPECT_EQ(cube.euler, 2);
  EXPECT_EQ(cube.components, 1u);
  EXPECT_TRUE(cube.is_closed());
  EXPECT_EQ(cube.non_manifold_edges + cube.non_manifold_vertices + cube.degenerate_faces, 0u);
  EXPECT_EQ(measure_topology(testing::polygon_mesh(testing::torus_knot_soup(40, 7))).euler, 0);
}

// Two quads in a row: 6 vertices, 7 edges, 6 of them open.
TEST(MeasureTopology, OpenStripByHand) {
  PolygonMesh mesh = testing::polygon_mesh({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}},
                                           {{0, 1, 4, 3}, {1, 2, 5, 4}});
  mesh.positions.emplace_back(5, 5, 5);  // of no face
  const MeshTopology t = measure_topology(mesh);
  EXPECT_EQ(t.vertices, 6u);
  EXPECT_EQ(t.edges, 7u);
  EXPECT_EQ(t.quads, 2u);
  EXPECT_EQ(t.boundary_edges, 6u);
  EXPECT_EQ(t.euler, 1);
  EXPECT_EQ(boundary_edges(mesh).size(), 6u);
  EXPECT_FALSE(t.is_closed());
}

TEST(MeasureTopology, NonManifold) {
  const std::vector<Vec3> p = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}, {-1, -1, 0}};
  const PolygonMesh three_at_an_edge = testing::polygon_mesh(p, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}});
  EXPECT_EQ(measure_topology(three_at_an_edge).non_manifold_edges, 1u);
  EXPECT_EQ(non_manifold_edges(three_at_an_edge), (std::vector<std::int32_t>{0}));
  EXPECT_EQ(measure_topology(three_at_an_edge).non_manifold_vertices, 0u);
  const PolygonMesh same_way = testing::polygon_mesh(p, {{0, 1, 2}, {0, 1, 4}});
  EXPECT_EQ(measure_topology(same_way).non_manifold_edges, 1u);
  const PolygonMesh bow_tie = testing::polygon_mesh(p, {{0, 1, 2}, {0, 5, 4}});
  EXPECT_EQ(measure_topology(bow_tie).non_manifold_vertices, 1u);
  EXPECT_EQ(measure_topology(bow_tie).components, 1u);
}

TEST(MeasureTopology, DegenerateFaces) {
  const std::vector<Vec3> p = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}, {1, 1, 0}};
  EXPECT_EQ(measure_topology(testing::polygon_mesh(p, {{0, 1, 2}, {0, 1, 3}, {1, 1, 2}, {1, 4, 2}}))
                .degenerate_faces,
            2u);
}

TEST(MeasureTopology, Empty) {
  const MeshTopology t = measure_topology(testing::polygon_mesh({}, {}));
  EXPECT_EQ(t.euler, 0);
  EXPECT_EQ(t.components, 0u);
}

TEST(FaceQualities, ByHand) {
  const PolygonMesh mesh = testing::polygon_mesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}},
                                                 {{0, 1, 2, 3}, {1, 4, 2}});
  const std::vector<double> q = face_qualities(mesh);
  ASSERT_EQ(q.size(), 2u);
  EXPECT_DOUBLE_EQ(q[0], 1);
  EXPECT_NEAR(q[1], std::sqrt(2.0 / 3), 1e-14);
}

}  // namespace
}  // namespace skinforge
