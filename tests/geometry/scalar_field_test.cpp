#include "geometry/scalar_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "testing/shapes.h"

namespace skinforge {
namespace {

// A row of three unit quads: vertices 0..3 below, 4..7 above.
PolygonMesh ladder() {
  std::vector<Vec3> positions;
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 4; ++x) positions.emplace_back(x, y, 0);
  return testing::polygon_mesh(positions, {{0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}});
}

TEST(SmoothScalar, OnePassByHand) {
  const VertexGraph graph = build_vertex_graph(ladder());
  const std::vector<double> values = {1, 1, 0, 0, 1, 1, 0, 0};
  const std::vector<std::uint8_t> all(8, 1);
  const std::vector<double> smooth = smooth_scalar(graph, values, all);
  EXPECT_DOUBLE_EQ(smooth[0], 1);                    // neighbours 1 and 4
  EXPECT_DOUBLE_EQ(smooth[1], 0.5 + 0.5 * 2.0 / 3);  // neighbours 0, 2, 5
  EXPECT_DOUBLE_EQ(smooth[2], 0.5 * 1.0 / 3);
  EXPECT_DOUBLE_EQ(smooth_scalar(graph, values, all, {.passes = 1, .self_weight = 0.8})[1],
                   0.8 + 0.2 * 2.0 / 3);
}

TEST(SmoothScalar, MaskAndConstantsStay) {
  const VertexGraph graph = build_vertex_graph(ladder());
  const std::vector<double> values = {1, 1, 0, 0, 1, 1, 0, 0};
  std::vector<std::uint8_t> mask(8, 0);
  mask[1] = 1;
  const std::vector<double> smooth = smooth_scalar(graph, values, mask, {.passes = 50});
  for (const std::size_t v : {0, 2, 3, 4, 5, 6, 7}) EXPECT_EQ(smooth[v], values[v]);
  EXPECT_NEAR(smooth[1], 2.0 / 3, 1e-12);  // the mean of its fixed neighbours
  EXPECT_EQ(smooth_scalar(graph, values, mask, {.passes = 0}), values);
  EXPECT_EQ(
      smooth_scalar(graph, std::vector<double>(8, 0.25), std::vector<std::uint8_t>(8, 1), {.passes = 7}),
      std::vector<double>(8, 0.25));
}

// Passes never leave the range of the values.
TEST(SmoothScalar, MaximumPrinciple) {
  const PolygonMesh mesh = testing::polygon_mesh(testing::sphere_soup(8));
  std::vector<double> values;
  for (const Vec3& p : mesh.positions) values.push_back(p.y() > 0 ? 1 : 0);
  for (const double v : smooth_scalar(build_vertex_graph(mesh), values,
                                      std::vector<std::uint8_t>(values.size(), 1), {.passes = 30})) {
    EXPECT_GE(v, 0);
    EXPECT_LE(v, 1);
  }
}

TEST(GeodesicDistance, LadderByHand) {
  const GeodesicDistance one = geodesic_distance(ladder(), std::vector{VertexId(0)});
  EXPECT_EQ(one.distance, (std::vector<double>{0, 1, 2, 3, 1, 2, 3, 4}));
  const GeodesicDistance two = geodesic_distance(ladder(), std::vector{VertexId(7), VertexId(0)});
  EXPECT_EQ(two.distance, (std::vector<double>{0, 1, 2, 1, 1, 2, 1, 0}));
  EXPECT_EQ(two.source[1], VertexId(0));
  EXPECT_EQ(two.source[2], VertexId(0));  // two steps from either: the lower id
  EXPECT_EQ(two.source[5], VertexId(0));
  EXPECT_EQ(two.source[3], VertexId(7));
}

TEST(GeodesicDistance, UnreachedAndEmpty) {
  PolygonMesh mesh = ladder();
  mesh.positions.emplace_back(9, 9, 9);  // of no face
  const GeodesicDistance none = geodesic_distance(mesh, {});
  EXPECT_EQ(none.distance[0], std::numeric_limits<double>::infinity());
  EXPECT_FALSE(none.source[0].is_valid());
  const GeodesicDistance one = geodesic_distance(mesh, std::vector{VertexId(3)});
  EXPECT_TRUE(std::isinf(one.distance[8]));
  EXPECT_FALSE(one.source[8].is_valid());
}

// Along edges it is never shorter than the straight line, and never differs by more than an edge between
// neighbours.
TEST(GeodesicDistance, Laws) {
  const PolygonMesh mesh = testing::polygon_mesh(testing::sphere_soup(10));
  const GeodesicDistance d = geodesic_distance(mesh, std::vector{VertexId(0)});
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v)
    EXPECT_GE(d.distance[v], (mesh.positions[v] - mesh.positions[0]).norm() - 1e-12);
  for (const Edge& e : build_edges(mesh).edges) {
    const std::size_t a = e.vertices[0].index(), b = e.vertices[1].index();
    EXPECT_LE(std::abs(d.distance[a] - d.distance[b]),
              (mesh.positions[a] - mesh.positions[b]).norm() + 1e-12);
  }
}

}  // namespace
}  // namespace skinforge
