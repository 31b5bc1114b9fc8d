#include "geometry/edges.h"

#include <gtest/gtest.h>

#include "testing/shapes.h"

namespace skinforge {
namespace {

const std::vector<Vec3> kSix = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}, {2, 1, 0}};

//  3---2---5      a quad and two triangles
//  |   | / |
//  0---1---4
PolygonMesh strip() {
  return testing::polygon_mesh(kSix, {{0, 1, 2, 3}, {1, 5, 2}, {1, 4, 5}});
}

TEST(BuildEdges, StripByHand) {
  const EdgeList list = build_edges(strip());
  ASSERT_EQ(list.edges.size(), 8u);
  EXPECT_EQ(list.edges[0].vertices, (std::array{VertexId(0), VertexId(1)}));
  EXPECT_EQ(list.edges[0].half_edges, (std::vector<std::int32_t>{0}));
  const Edge& shared = list.edges[list.edge_of_corner[1]];  // corner 1 of the quad: from vertex 1 to 2
  EXPECT_EQ(shared.vertices, (std::array{VertexId(1), VertexId(2)}));
  EXPECT_EQ(shared.half_edges, (std::vector<std::int32_t>{1, 6}));  // 6: from vertex 2 back to 1
  EXPECT_EQ(list.next_corner[3], 0);
  EXPECT_EQ(list.next_corner[6], 4);
  EXPECT_EQ(list.face_of_corner[6], FaceId(1));
  for (std::size_t e = 1; e < list.edges.size(); ++e)
    EXPECT_LT(list.edges[e - 1].vertices, list.edges[e].vertices);
}

TEST(BuildEdges, NonManifoldEdgeListsAllFaces) {
  const PolygonMesh fan = testing::polygon_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}},
                                                {{0, 1, 2}, {0, 1, 3}, {1, 0, 4}});
  EXPECT_EQ(build_edges(fan).edges[0].half_edges, (std::vector<std::int32_t>{0, 3, 6}));
}

// Each corner belongs to exactly one half-edge of exactly the edge it names.
TEST(BuildEdges, CornersAndEdgesAgree) {
  const PolygonMesh mesh = testing::polygon_mesh(testing::torus_knot_soup(30, 6));
  const EdgeList list = build_edges(mesh);
  EXPECT_EQ(list.edges.size(), mesh.corner_count() / 2);  // closed and manifold
  for (std::size_t e = 0; e < list.edges.size(); ++e) {
    EXPECT_EQ(list.edges[e].half_edges.size(), 2u);
    for (const std::int32_t c : list.edges[e].half_edges)
      EXPECT_EQ(list.edge_of_corner[c], static_cast<std::int32_t>(e));
  }
}

TEST(BuildVertexGraph, NeighboursRise) {
  const VertexGraph graph = build_vertex_graph(strip());
  const auto of_one = graph.of(VertexId(1));
  EXPECT_EQ(std::vector<VertexId>(of_one.begin(), of_one.end()),
            (std::vector{VertexId(0), VertexId(2), VertexId(4), VertexId(5)}));
  EXPECT_EQ(graph.of(VertexId(3)).size(), 2u);
}

// Two triangles that meet in one vertex are one component; the far one is another; vertex 8 is in none.
TEST(ConnectedComponents, SharedVertexConnects) {
  std::vector<Vec3> positions(9, Vec3::Zero());
  const PolygonMesh mesh = testing::polygon_mesh(positions, {{5, 6, 7}, {0, 1, 2}, {2, 3, 4}});
  const Components components = connected_components(mesh);
  EXPECT_EQ(components.count, 2);
  EXPECT_EQ(components.of_face, (std::vector<std::int32_t>{0, 1, 1}));
  EXPECT_EQ(components.of_vertex, (std::vector<std::int32_t>{1, 1, 1, 1, 1, 0, 0, 0, -1}));
}

// Edges of the strip: seven of length 1 and the diagonal.
TEST(MeanEdgeLength, StripByHand) {
  EXPECT_DOUBLE_EQ(mean_edge_length(strip()), (7 + std::sqrt(2.0)) / 8);
  EXPECT_EQ(mean_edge_length(testing::polygon_mesh({}, {})), 0);
}

TEST(Edges, EmptyMesh) {
  const PolygonMesh empty = testing::polygon_mesh({}, {});
  EXPECT_TRUE(build_edges(empty).edges.empty());
  EXPECT_EQ(build_vertex_graph(empty).begin, (std::vector<std::int32_t>{0}));
  EXPECT_EQ(connected_components(empty).count, 0);
}

}  // namespace
}  // namespace skinforge
