#include "surface/tube_domain.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "surface/best_tube.h"
#include "surface/improve_faces.h"
#include "surface/patch_parts.h"
#include "surface/quad_gate.h"
#include "surface/shapes.h"
#include "surface/tube.h"
#include "surface/tube_scenes.h"

namespace skinforge {
namespace {

// A flat board of unit squares, each cut in two, with square holes; border vertices first, loop after loop.
struct Board {
  std::vector<JunctionLoop> loops;
  TrianglePatch patch;

  using Hole = std::array<int, 4>;  // x and y of its first square, and how many

  Board(int width, int height, const std::vector<Hole>& holes) {
    const auto is_hole = [&](int x, int y) {
      return std::any_of(holes.begin(), holes.end(), [&](const Hole& h) {
        return x >= h[0] && x < h[0] + h[2] && y >= h[1] && y < h[1] + h[3];
      });
    };
    TrianglePatch raw;
    for (int y = 0; y <= height; ++y)
      for (int x = 0; x <= width; ++x) raw.positions.emplace_back(x, y, 0);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        if (is_hole(x, y)) continue;
        const std::int32_t a = x + (width + 1) * y, b = a + 1, c = b + width + 1, d = a + width + 1;
        raw.triangles.push_back({a, b, c});
        raw.triangles.push_back({a, c, d});
      }
    std::vector<std::int32_t> name(raw.positions.size(), -1);
    for (const auto& loop : boundary_loops(raw.triangles)) {
      JunctionLoop found{SourceId(loops.size()), loops.empty(), {}, {}, {}};
      for (const std::int32_t v : loop) add(raw, name, v), found.positions.push_back(raw.positions[v]);
      found.inward.resize(found.positions.size());
      loops.push_back(found);
    }
    patch.fixed = patch.positions.size();
    for (const Triangle& t : raw.triangles)
      for (const std::int32_t v : t) add(raw, name, v);
    for (const Triangle& t : raw.triangles) patch.triangles.push_back({name[t[0]], name[t[1]], name[t[2]]});
  }

  static WantedSurface surface() {
    return {[](const Vec3& p) { return Vec3(p.x(), p.y(), 0); }, [](const Vec3&) { return Vec3(0, 0, 1); }};
  }

 private:
  void add(const TrianglePatch& raw, std::vector<std::int32_t>& name, std::int32_t v) {
    if (name[v] >= 0) return;
    name[v] = static_cast<std::int32_t>(patch.positions.size());
    patch.positions.push_back(raw.positions[v]);
  }
};

std::multiset<std::size_t> loop_sizes(const TrianglePatch& patch) {
  std::multiset<std::size_t> sizes;
  for (const auto& loop : boundary_loops(patch.triangles)) sizes.insert(loop.size());
  return sizes;
}

TEST(TubeDomains, TwoLoopsNeedNoSeam) {
  const Board board(12, 10, {{5, 4, 2, 2}});
  const auto domain = tube_domain(board.patch, board.loops);
  ASSERT_TRUE(domain);
  EXPECT_TRUE(domain->seams.empty());
  EXPECT_EQ(domain->a.points.size(), 44u);
  EXPECT_EQ(domain->b.points.size(), 8u);
}

// By hand: the holes are 4 apart, so joined they have 8 + 8 + 2 * 4 edges, and 3 new vertices between them.
TEST(TubeDomains, ASeamJoinsTwoHoles) {
  const Board board(16, 10, {{4, 4, 2, 2}, {10, 4, 2, 2}});
  ASSERT_EQ(board.loops.size(), 3u);
  const auto outside = tube_domain(board.patch, board.loops);  // the outer border against the two holes
  ASSERT_TRUE(outside);
  EXPECT_EQ(outside->a.points.size(), 52u);
  EXPECT_EQ(outside->b.points.size(), 8u + 8 + 2 * 4);
  ASSERT_EQ(outside->seams.size(), 3u);
  for (const Vec3& p : outside->seams) EXPECT_NEAR(p.x() - std::round(p.x()), 0, 1e-12);
  EXPECT_EQ(loop_sizes(outside->patch), (std::multiset<std::size_t>{24, 52}));
  EXPECT_FALSE(even_domain(board.patch, board.loops));  // three loops have no two sides of two
}

// By hand: of a square frame's four holes in a row the ends and the middles are no pairs that stand as even
// as the frame of 24 with the nearest hole (24 + 4 + 2 * 1) against the other two (4 + 4 + 2 * 2).
TEST(TubeDomains, FourLoopsStandTwoByTwo) {
  const Board board(9, 3, {{1, 1, 1, 1}, {4, 1, 1, 1}, {7, 1, 1, 1}});
  ASSERT_EQ(board.loops.size(), 4u);
  const auto domain = even_domain(board.patch, board.loops);
  ASSERT_TRUE(domain);
  EXPECT_EQ(domain->a.points.size(), 24u + 4 + 2 * 1);
  EXPECT_EQ(domain->b.points.size(), 4u + 4 + 2 * 2);
}

// Law: whichever borders stand together, the quads close on all of them as they were.
TEST(TubeDomains, TubesWithSeamsAreWatertight) {
  const Board two(16, 10, {{4, 4, 2, 2}, {10, 4, 2, 2}}),
      three(22, 10, {{4, 4, 2, 2}, {10, 4, 2, 2}, {16, 4, 2, 2}});
  for (const auto& [board, domain, holes] : {std::tuple(&two, tube_domain(two.patch, two.loops), 2),
                                             std::tuple(&three, tube_domain(three.patch, three.loops), 3),
                                             std::tuple(&three, even_domain(three.patch, three.loops), 3)}) {
    ASSERT_TRUE(domain);
    std::multiset<std::size_t> borders = {holes == 2 ? 52u : 64u};
    for (int k = 0; k < holes; ++k) borders.insert(8);
    std::string fault;
    const auto tube = QuadTube::make(*domain, fault);
    ASSERT_TRUE(tube) << fault;
    const auto table = tube->table(tube->wanted_rows(), {});
    ASSERT_TRUE(table);
    const QuadPatch quads = testing::finished(tube->laid(*table, tube->wanted_rows()), Board::surface());
    EXPECT_TRUE(quads.triangles.empty());
    const TrianglePatch halves = halved(quads);
    for (const auto& [edge, uses] : testing::half_edge_uses(halves.triangles)) EXPECT_EQ(uses, 1);
    EXPECT_EQ(loop_sizes(halves), borders);
    EXPECT_EQ(testing::topology_of(halves).euler, 1 - holes);
    EXPECT_EQ(testing::topology_of(halves).non_manifold_vertices, 0u);
    for (std::size_t v = 0; v < quads.fixed; ++v) EXPECT_EQ(quads.positions[v], board->patch.positions[v]);
  }
}

// Two boards side by side are two parts, each with its own loops; put together again they are what they were.
TEST(SplitParts, EachPartHasItsLoops) {
  const Board board(12, 6, {{5, 0, 2, 6}, {1, 2, 2, 2}});
  ASSERT_EQ(board.loops.size(), 3u);
  const auto parts = split_parts(board.patch, board.loops);
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_EQ(parts[0].loops.size() + parts[1].loops.size(), 3u);
  QuadPatch whole{{board.patch.positions.begin(),
                   board.patch.positions.begin() + static_cast<std::ptrdiff_t>(board.patch.fixed)},
                  {},
                  {},
                  board.patch.fixed};
  for (const PatchPart& part : parts) add_part(whole, part, triangles_of(part));
  EXPECT_EQ(whole.positions.size(), board.patch.positions.size());
  EXPECT_EQ(whole.triangles.size(), board.patch.triangles.size());
  EXPECT_EQ(loop_sizes(halved(whole)), loop_sizes(board.patch));
}

// Nine squares of a chessboard whose inner vertex was dragged over its neighbour: it comes back.
TEST(ImproveFaces, AFoldedVertexComesBack) {
  QuadPatch patch;
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 3; ++x)
      if (x != 1 || y != 1) patch.positions.emplace_back(x, y, 0);
  patch.fixed = 8;
  patch.positions.emplace_back(1.9, 1.7, 0);
  patch.quads = {{0, 1, 8, 3}, {1, 2, 4, 8}, {3, 8, 6, 5}, {8, 4, 7, 6}};
  const double before = least_scaled_jacobian(patch);
  for (const FaceGoal goal : {FaceGoal::All, FaceGoal::Worst}) improve_faces(patch, Board::surface(), goal);
  EXPECT_GT(least_scaled_jacobian(patch), before + 0.2);
  EXPECT_GT(least_scaled_jacobian(patch), 0.5);
}

TEST(QuadGate, SaysWhatIsWrong) {
  DistanceField plane;  // z - 0.5 on a lattice of step 1
  plane.lattice.origin = Vec3(-2, -2, -2);
  plane.lattice.voxel = 1;
  plane.lattice.size = {8, 8, 8};
  for (int z = 0; z < 8; ++z)
    for (int k = 0; k < 64; ++k) plane.values.push_back(static_cast<float>(z - 2) - 0.5F);
  QuadPatch patch{{{0, 0, 0.5}, {1, 0, 0.5}, {1, 1, 0.5}, {0, 1, 0.5}}, {{0, 1, 2, 3}}, {}, 0};
  EXPECT_EQ(fault_of(patch, plane), "");
  patch.quads = {{3, 2, 1, 0}};
  EXPECT_EQ(fault_of(patch, plane), "1 faces against the field");
  patch.quads = {{0, 1, 2, 3}};
  patch.positions[2] = Vec3(0.1, 0.1, 0.5);
  EXPECT_THAT(fault_of(patch, plane), ::testing::StartsWith("least scaled Jacobian"));
  for (Vec3& p : patch.positions) p.z() = 3.4;
  patch.positions[2] = Vec3(1, 1, 3.4);
  EXPECT_EQ(fault_of(patch, plane), "2.9 voxels off the field at 95 %, 2.9 at most");
}

}  // namespace
}  // namespace skinforge
