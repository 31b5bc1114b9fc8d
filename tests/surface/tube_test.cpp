#include "surface/tube.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "surface/tube_chart.h"
#include "surface/tube_mesh.h"
#include "surface/tube_scenes.h"

namespace skinforge {
namespace {

constexpr double kStraight = std::numbers::pi;

using testing::even_heights;
using testing::even_side;
using testing::Wall;

int count_of(const TubeTable& table, TubeOpKind kind) {
  return static_cast<int>(
      std::count_if(table.ops.begin(), table.ops.end(), [&](const TubeOp& op) { return op.kind == kind; }));
}

TEST(SolveTube, EqualCountsMatchEdgeByEdge) {
  const auto table = solve_tube(even_side(12), even_side(12, 0.26), 4);
  ASSERT_TRUE(table);
  EXPECT_EQ(count_of(*table, TubeOpKind::Match), 12);
  EXPECT_EQ(table->ops.size(), 12u);
  EXPECT_EQ(table->start, 9u);  // 0.26 + 9/12 is nearest to a whole turn
}

TEST(SolveTube, TwoMoreEdgesEndInOneDiamond) {
  const auto table = solve_tube(even_side(14), even_side(12), 4);
  ASSERT_TRUE(table);
  EXPECT_EQ(count_of(*table, TubeOpKind::StackA), 1);
  EXPECT_EQ(count_of(*table, TubeOpKind::Match), 12);
}

// The corner at vertex 5 is where the border turns in: the stack's middle stands there.
TEST(SolveTube, AStackGoesWhereTheBorderTurnsIn) {
  TubeSide a = even_side(14);
  a.angle[5] = kStraight / 2;
  const auto table = solve_tube(a, even_side(12), 4);
  ASSERT_TRUE(table);
  for (const TubeOp& op : table->ops)
    if (op.kind == TubeOpKind::StackA) {
      EXPECT_EQ(op.middle, 5);
    }
}

// The same counts, but between edges that all but meet at vertex 5 no column ends: one quad takes both, and B
// gives up two edges, too.
TEST(SolveTube, NoColumnEndsInASharpNotch) {
  TubeSide a = even_side(12);
  a.angle[5] = kStraight / 18;
  const auto table = solve_tube(a, even_side(12), 4);
  ASSERT_TRUE(table);
  EXPECT_EQ(count_of(*table, TubeOpKind::StackB), 1);
  ASSERT_EQ(count_of(*table, TubeOpKind::StackA), 1);
  for (const TubeOp& op : table->ops) {
    if (op.kind == TubeOpKind::StackA) {
      EXPECT_EQ(op.middle, 5);
    }
  }
}

TEST(SolveTube, NoRowsForAStack) {
  EXPECT_FALSE(solve_tube(even_side(14), even_side(12), 2));
  EXPECT_TRUE(solve_tube(even_side(12), even_side(12), 2));
}

// Vertices by hand: 6 + 4 on the borders, a row of 6 and one of 4 between them.
TEST(TubeMeshOf, ADiamondByHand) {
  const TubeSide a = even_side(6), b = even_side(4);
  const auto table = solve_tube(a, b, 3);
  ASSERT_TRUE(table);
  const TubeMesh mesh = mesh_of(*table, a, b, even_heights(3));
  EXPECT_EQ(mesh.row.size(), 6u + 4 + 6 + 4);
  EXPECT_EQ(mesh.quads.size(), 6u + 5 + 4);
  EXPECT_TRUE(mesh.triangles.empty());
}

class TubeCounts : public ::testing::TestWithParam<int> {};

// Law: a closed band of quads with two borders of n and m edges, one triangle when n + m is odd.
TEST_P(TubeCounts, AnyCountsGiveAWatertightTube) {
  std::mt19937 random(static_cast<unsigned>(GetParam()));
  const auto pick = [&](int low, int high) {
    return low + static_cast<int>(random() % static_cast<unsigned>(high - low + 1));
  };
  const int n = pick(6, 60), m = pick(6, 60), rows = pick(6, 12);
  const TubeSide a = even_side(n), b = even_side(m, 0.01 * pick(0, 99));
  SCOPED_TRACE(::testing::Message() << n << " to " << m << " in " << rows);
  const auto table = solve_tube(a, b, rows);
  ASSERT_TRUE(table);
  const TubeMesh mesh = mesh_of(*table, a, b, even_heights(rows));
  EXPECT_EQ(mesh.triangles.size(), static_cast<std::size_t>((n + m) % 2));
  TrianglePatch patch{std::vector<Vec3>(mesh.row.size(), Vec3::Zero()), mesh.triangles, 0};
  for (const Quad& q : mesh.quads) {
    EXPECT_EQ(std::set<std::int32_t>(q.begin(), q.end()).size(), 4u);
    patch.triangles.push_back({q[0], q[1], q[2]});
    patch.triangles.push_back({q[0], q[2], q[3]});
  }
  for (const auto& [edge, uses] : testing::half_edge_uses(patch.triangles)) EXPECT_EQ(uses, 1);
  const auto loops = boundary_loops(patch.triangles);
  ASSERT_EQ(loops.size(), 2u);
  EXPECT_EQ(loops[0].size(), static_cast<std::size_t>(n));
  EXPECT_EQ(loops[1].size(), static_cast<std::size_t>(m));
  EXPECT_EQ(testing::topology_of(patch).euler, 0);
  EXPECT_EQ(testing::topology_of(patch).components, 1u);
  EXPECT_EQ(testing::topology_of(patch).non_manifold_vertices, 0u);
}

INSTANTIATE_TEST_SUITE_P(Random, TubeCounts, ::testing::Range(0, 200));

IndexLoop up_to(std::int32_t first, std::int32_t end) {
  IndexLoop loop;
  for (std::int32_t v = first; v < end; ++v) loop.push_back(v);
  return loop;
}

// On a cylinder u is the height and theta the angle.
TEST(TubeChart, CylinderByHand) {
  const Wall wall(24, 24, 3);
  IndexLoop b = up_to(24, 48);
  std::reverse(b.begin(), b.end());
  const auto chart = TubeChart::make(wall.domain, up_to(0, 24), b);
  ASSERT_TRUE(chart);
  for (int k = 0; k < 24; ++k) EXPECT_NEAR(chart->theta_a()[k] - chart->theta_a()[0], k / 24.0, 0.01);
  EXPECT_NEAR(chart->lengths(10).back(), 3, 0.05);
  const double zero = chart->theta_a()[0];
  const Vec3 middle = chart->at(0.5, zero + 0.25);
  EXPECT_LT((middle - Vec3(1, 1.5, 0)).norm(), 0.08);
}

TEST(TubeChart, ADiscIsNoTube) {
  const std::vector<Vec3> loop = testing::ring(12);
  const TrianglePatch disc{loop, fill_loop(loop), loop.size()};
  EXPECT_FALSE(TubeChart::make(disc, up_to(0, 12), up_to(0, 12)));
}

// The tube of the rows it asks for.
void make_tube(const Wall& wall, QuadPatch& tube) {
  std::string fault;
  const auto domain = tube_domain(wall.domain, wall.loops);
  ASSERT_TRUE(domain);
  const auto tubes = QuadTube::make(*domain, fault);
  ASSERT_TRUE(tubes) << fault;
  const auto table = tubes->table(tubes->wanted_rows(), {});
  ASSERT_TRUE(table);
  tube = testing::finished(tubes->laid(*table, tubes->wanted_rows()), Wall::surface());
}

// Same counts: rows and columns of rectangles as deep as they are wide.
TEST(QuadTube, EqualCountsGiveAGrid) {
  const Wall wall(24, 24, 3);
  QuadPatch tube;
  ASSERT_NO_FATAL_FAILURE(make_tube(wall, tube));
  EXPECT_EQ(tube.quads.size(), 24u * 11);  // 3 / (2 pi / 24) is 11.5 arcs, and 11.49 edges
  EXPECT_TRUE(tube.triangles.empty());
  EXPECT_GT(least_scaled_jacobian(tube), 0.9);
  EXPECT_EQ(tube.fixed, 48u);
}

class TubeQuality : public ::testing::TestWithParam<std::pair<int, int>> {};

TEST_P(TubeQuality, OnACylinder) {
  const auto [n, m] = GetParam();
  const Wall wall(n, m, 4);
  QuadPatch tube;
  ASSERT_NO_FATAL_FAILURE(make_tube(wall, tube));
  EXPECT_EQ(tube.triangles.size(), static_cast<std::size_t>((n + m) % 2));
  EXPECT_GE(least_scaled_jacobian(tube), 0.2);
  const TrianglePatch halves = halved(tube);
  const MeshTopology topology = testing::topology_of(halves);
  EXPECT_EQ(topology.euler, 0);
  EXPECT_EQ(topology.non_manifold_edges + topology.non_manifold_vertices + topology.degenerate_faces, 0u);
  for (std::size_t v = 0; v < tube.fixed; ++v) EXPECT_EQ(tube.positions[v], wall.domain.positions[v]);
}

INSTANTIATE_TEST_SUITE_P(Counts, TubeQuality,
                         ::testing::Values(std::pair{16, 16}, std::pair{24, 16}, std::pair{16, 24},
                                           std::pair{24, 17}, std::pair{32, 8}, std::pair{9, 30},
                                           std::pair{6, 7}, std::pair{44, 12}));

}  // namespace
}  // namespace skinforge
