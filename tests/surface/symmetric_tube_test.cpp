#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "surface/symmetric_table.h"
#include "surface/tube.h"
#include "surface/tube_mesh.h"
#include "surface/tube_scenes.h"

namespace skinforge {
namespace {

using testing::even_heights;
using testing::even_side;
using testing::Wall;

// Vertices i and sum - i of both borders are images.
PatchMirror reflections(int n, int sum_a, int m, int sum_b) {
  PatchMirror borders{{Vec3::UnitX(), 0}, {}};
  for (int i = 0; i < n; ++i) borders.image.push_back((((sum_a - i) % n) + n) % n);
  for (int j = 0; j < m; ++j) borders.image.push_back(n + (((sum_b - j) % m) + m) % m);
  return borders;
}

QuadPatch faces_of(const TubeMesh& mesh, int n, int m) {
  return {std::vector<Vec3>(mesh.row.size(), Vec3::Zero()), mesh.quads, mesh.triangles,
          static_cast<std::size_t>(n + m)};
}

int count_of(const TubeTable& table, TubeOpKind kind) {
  return static_cast<int>(
      std::count_if(table.ops.begin(), table.ops.end(), [&](const TubeOp& op) { return op.kind == kind; }));
}

TEST(LoopReflection, ByHand) {
  const std::vector<std::int32_t> loop = {10, 11, 12, 13, 14};
  const std::vector<std::int32_t> images = {12, 11, 10, 14, 13};  // i to 2 - i
  ASSERT_TRUE(loop_reflection(loop, images));
  EXPECT_EQ(loop_reflection(loop, images)->sum, 2);
  EXPECT_FALSE(loop_reflection(loop, std::vector<std::int32_t>{11, 12, 13, 14, 10}));  // a turn
}

// Two edges more: one diamond. Alone it can only stand on the plane.
TEST(SolveSymmetricTube, OneDiamondStandsOnThePlane) {
  TubeSide a = even_side(14), b = even_side(12);
  const auto table = solve_symmetric_tube(a, {0}, b, {0}, 4);
  ASSERT_TRUE(table);
  ASSERT_EQ(count_of(*table, TubeOpKind::StackA), 1);
  for (const TubeOp& op : table->ops)
    if (op.kind == TubeOpKind::StackA) {
      EXPECT_THAT(op.middle, ::testing::AnyOf(0, 7));
    }
  EXPECT_EQ(count_of(*table, TubeOpKind::Match), 12);
}

// 9 + 12 edges: the one triangle stands on the edge of A that crosses the plane, opposite vertex 6 of B.
TEST(SolveSymmetricTube, OneTriangleStandsOnThePlane) {
  const auto table = solve_symmetric_tube(even_side(9), {0}, even_side(12), {0}, 4);
  ASSERT_TRUE(table);
  EXPECT_EQ(count_of(*table, TubeOpKind::TriangleA), 1);
  EXPECT_EQ(count_of(*table, TubeOpKind::TriangleB), 0);
  for (const TubeOp& op : table->ops)
    if (op.kind == TubeOpKind::TriangleA) {
      EXPECT_EQ(op.middle, 4);
    }
}

// Both vertices of A on the plane, both of B's crossings in edges: that takes two triangles. Edges against
// edges have pairs of diamonds, none on the plane: 4 edges more are one pair, 2 are none.
TEST(SolveSymmetricTube, VerticesAgainstEdgesHaveNoPureQuads) {
  EXPECT_FALSE(solve_symmetric_tube(even_side(12), {0}, even_side(10, 0.05), {-1}, 4));
  EXPECT_TRUE(solve_symmetric_tube(even_side(12, 1.0 / 24), {-1}, even_side(8, 1.0 / 16), {-1}, 4));
  EXPECT_FALSE(solve_symmetric_tube(even_side(12, 1.0 / 24), {-1}, even_side(10, 0.05), {-1}, 4));
}

// Whether columns can be mirrored: at most one crossing has an edge against a vertex, and as diamonds come in
// pairs, the halves differ by an even number of edges, unless one can stand on vertices on the plane.
bool is_possible(int n, int sum_a, int m, int sum_b) {
  const int a0 = sum_a % 2, a1 = (sum_a + n) % 2, b0 = sum_b % 2, b1 = (sum_b + m) % 2;  // 1: in an edge
  if (a0 != b0 && a1 != b1) return false;
  const bool has_vertices = (a0 == 0 && b0 == 0) || (a1 == 0 && b1 == 0);
  return has_vertices || ((n - a0 - a1) / 2 - (m - b0 - b1) / 2) % 2 == 0;
}

class SymmetricCounts : public ::testing::TestWithParam<int> {};

// Law: every possible pair of reflections has a watertight tube, whose faces are images of each other, with a
// triangle where an edge crosses the plane against a vertex.
TEST_P(SymmetricCounts, FacesAreImagesOfEachOther) {
  std::mt19937 random(static_cast<unsigned>(GetParam()));
  const auto pick = [&](int low, int high) {
    return low + static_cast<int>(random() % static_cast<unsigned>(high - low + 1));
  };
  const int n = pick(6, 60), m = pick(6, 60), rows = pick(6, 12), sum_a = pick(0, 1), sum_b = pick(0, 1);
  SCOPED_TRACE(::testing::Message() << n << " (" << sum_a << ") to " << m << " (" << sum_b << ") in "
                                    << rows);
  const TubeSide a = even_side(n, 1 - 0.5 * sum_a / n), b = even_side(m, 1 - 0.5 * sum_b / m);
  const int first = sum_a != sum_b, last = (sum_a + n) % 2 != (sum_b + m) % 2;
  const auto table = solve_symmetric_tube(a, {sum_a}, b, {sum_b}, rows);
  ASSERT_EQ(table.has_value(), is_possible(n, sum_a, m, sum_b));
  if (!table) return;
  const QuadPatch patch = faces_of(mesh_of(*table, a, b, even_heights(rows)), n, m);
  EXPECT_EQ(patch.triangles.size(), static_cast<std::size_t>(first + last));
  EXPECT_TRUE(mirror_of(patch, reflections(n, sum_a, m, sum_b)));
  const TrianglePatch halves = halved(patch);
  for (const auto& [edge, uses] : testing::half_edge_uses(halves.triangles)) EXPECT_EQ(uses, 1);
  EXPECT_EQ(boundary_loops(halves.triangles).size(), 2u);
}

INSTANTIATE_TEST_SUITE_P(Random, SymmetricCounts, ::testing::Range(0, 200));

// What mirroring across x = 0 makes of the borders of a wall, by their places.
PatchMirror borders_of(const Wall& wall) {
  PatchMirror borders{{Vec3::UnitX(), 0}, {}};
  for (std::size_t v = 0; v < wall.domain.fixed; ++v) {
    const Vec3 place = borders.plane.mirrored(wall.domain.positions[v]);
    for (std::size_t w = 0; w < wall.domain.fixed; ++w)
      if ((wall.domain.positions[w] - place).norm() < 1e-9)
        borders.image.push_back(static_cast<std::int32_t>(w));
  }
  return borders;
}

class SymmetricTube : public ::testing::TestWithParam<std::array<int, 2>> {};

// The counts of junction.md d.1, and odd ones: new vertices lie across the plane to the last bit.
TEST_P(SymmetricTube, DeviationIsExactlyZero) {
  const auto [n, m] = GetParam();
  const Wall wall(n, m, 4, 0);
  const PatchMirror borders = borders_of(wall);
  ASSERT_EQ(borders.image.size(), wall.domain.fixed);
  std::string fault;
  const auto domain = tube_domain(wall.domain, wall.loops);
  ASSERT_TRUE(domain);
  const auto tube = QuadTube::make(*domain, fault);
  ASSERT_TRUE(tube) << fault;
  const auto table = tube->symmetric_table(tube->wanted_rows(), {}, borders);
  ASSERT_TRUE(table);
  const QuadPatch laid = tube->laid(*table, tube->wanted_rows());
  const auto mirror = mirror_of(laid, borders);
  ASSERT_TRUE(mirror);
  const WantedSurface cylinder = Wall::surface();
  const WantedSurface wanted = mirrored(cylinder, mirror->plane);
  QuadPatch made = testing::finished(laid, wanted, &*mirror);
  EXPECT_GE(least_scaled_jacobian(made), 0.2);
  improve_faces(made, wanted, FaceGoal::Settled, &*mirror);
  EXPECT_GE(least_scaled_jacobian(made), 0.2);
  EXPECT_EQ(made.triangles.size(), static_cast<std::size_t>((n + m) % 2));
  for (std::size_t v = made.fixed; v < made.positions.size(); ++v)
    EXPECT_EQ(made.positions[static_cast<std::size_t>(mirror->image[v])],
              mirror->plane.mirrored(made.positions[v]));
}

INSTANTIATE_TEST_SUITE_P(Counts, SymmetricTube,
                         ::testing::Values(std::array{24, 16}, std::array{28, 20}, std::array{44, 12},
                                           std::array{28, 14}, std::array{16, 16}, std::array{24, 17},
                                           std::array{9, 30}, std::array{13, 9}));

// The free solver's faces are no images of each other when a stack stands beside the plane.
TEST(MirrorOf, NoneForFacesThatAreNotSymmetric) {
  const TubeSide a = even_side(14), b = even_side(12);
  TubeTable table{0, 0, {}, 0, {}};
  table.ops.push_back({TubeOpKind::StackA, 1, 1});
  for (int k = 0; k < 12; ++k) table.ops.push_back({});
  const QuadPatch patch = faces_of(mesh_of(table, a, b, even_heights(4)), 14, 12);
  EXPECT_FALSE(mirror_of(patch, reflections(14, 0, 12, 0)));
  EXPECT_TRUE(mirror_of(patch, reflections(14, 2, 12, 0)));  // about vertex 1 it is
}

}  // namespace
}  // namespace skinforge
