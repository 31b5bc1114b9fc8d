#include "surface/remesh.h"

#include <gtest/gtest.h>

#include "surface/chords.h"
#include "surface/ring_zip.h"
#include "surface/shapes.h"

namespace skinforge {
namespace {

constexpr int kAround = 16;
const double kBorderEdge = 2 * std::sin(std::numbers::pi / kAround);

// The wall between two rings, as a junction is before remeshing: long triangles from ring to ring.
TrianglePatch tube_wall(double height) {
  std::vector<Vec3> low = testing::ring(kAround), high = testing::ring(kAround, 1, height, 0.1);
  const auto triangles = zip_rings(low, high, nullptr);
  low.insert(low.end(), high.begin(), high.end());
  return split_chords({low, triangles, low.size()});
}

Vec3 onto_cylinder(const Vec3& p) {
  const double radius = std::hypot(p.x(), p.z());
  return {p.x() / radius, p.y(), p.z() / radius};
}

std::vector<double> free_edge_lengths(const TrianglePatch& patch) {
  std::vector<double> lengths;
  for (const auto& [edge, number] : testing::half_edge_uses(patch.triangles)) {
    const bool is_fixed = static_cast<std::size_t>(std::max(edge.first, edge.second)) < patch.fixed;
    if (edge.first < edge.second && !is_fixed)
      lengths.push_back((patch.positions[edge.first] - patch.positions[edge.second]).norm());
  }
  return lengths;
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

void expect_same_frame(const TrianglePatch& before, const TrianglePatch& after) {
  ASSERT_EQ(after.fixed, before.fixed);
  for (std::size_t v = 0; v < before.fixed; ++v) EXPECT_EQ(after.positions[v], before.positions[v]);
  EXPECT_EQ(boundary_loops(after.triangles), boundary_loops(before.triangles));
  const MeshTopology old = testing::topology_of(before), now = testing::topology_of(after);
  EXPECT_EQ(now.euler, old.euler);
  EXPECT_EQ(now.components, old.components);
  EXPECT_EQ(now.non_manifold_edges + now.non_manifold_vertices + now.degenerate_faces, 0u);
  EXPECT_EQ(now.vertices, after.positions.size());
  EXPECT_EQ(testing::chord_count(after), 0);
}

TEST(Remesh, TubeWallOnItsCylinder) {
  const TrianglePatch before = tube_wall(3), after = remesh(before, onto_cylinder);
  expect_same_frame(before, after);
  EXPECT_EQ(testing::topology_of(after).euler, 0);
  const auto lengths = free_edge_lengths(after);
  // Lengths spread evenly between 4/5 and 4/3 have the mean 1.07; the rest is room for relaxation.
  EXPECT_NEAR(mean(lengths), kBorderEdge, 0.12 * kBorderEdge);
  // Four splits and collapses apart by the ratios 4/5 and 4/3; relaxation moves the ends once more.
  EXPECT_GT(*std::min_element(lengths.begin(), lengths.end()), 0.5 * kBorderEdge);
  EXPECT_LT(*std::max_element(lengths.begin(), lengths.end()), 1.6 * kBorderEdge);
  for (const Vec3& p : after.positions) EXPECT_NEAR(std::hypot(p.x(), p.z()), 1, 0.02);
}

// Half the length asks for four times the faces inside; the borders stay as they are, and so do the faces
// along them. The patch has vertices inside already, as an isosurface has.
TEST(Remesh, FinerInside) {
  const TrianglePatch before = remesh(tube_wall(6), onto_cylinder);
  const TrianglePatch fine = remesh(before, onto_cylinder, {.length_scale = 0.5});
  expect_same_frame(before, fine);
  EXPECT_GT(fine.triangles.size(), 3 * before.triangles.size());
  EXPECT_LT(fine.triangles.size(), 5 * before.triangles.size());
}

// Without a projection free vertices go to the mean of their neighbours, so a flat disc stays flat.
TEST(Remesh, FlatDiscStaysFlat) {
  const std::vector<Vec3> loop = testing::ring(24);
  const TrianglePatch before = split_chords({loop, fill_loop(loop), loop.size()});
  const TrianglePatch after = remesh(before, nullptr);
  expect_same_frame(before, after);
  EXPECT_GT(after.positions.size(), before.fixed);
  for (const Vec3& p : after.positions) EXPECT_NEAR(p.y(), 0, 1e-12);
  EXPECT_NEAR(testing::area_of(after), testing::area_of(before), 1e-12);
}

// Coarse on one side, fine on the other: edges grow from one to the other.
TEST(Remesh, LengthsGoFromOneBorderToTheOther) {
  std::vector<Vec3> low = testing::ring(8), high = testing::ring(32, 1, 4);
  const auto triangles = zip_rings(low, high, nullptr);
  low.insert(low.end(), high.begin(), high.end());
  const TrianglePatch before = split_chords({low, triangles, low.size()});
  const TrianglePatch after = remesh(before, onto_cylinder);
  expect_same_frame(before, after);
  std::vector<double> at_low, at_high;
  for (const auto& [edge, number] : testing::half_edge_uses(after.triangles)) {
    const Vec3 &a = after.positions[edge.first], &b = after.positions[edge.second];
    if (a.y() + b.y() < 2) at_low.push_back((a - b).norm());
    if (a.y() + b.y() > 6) at_high.push_back((a - b).norm());
  }
  EXPECT_GT(mean(at_low), 1.8 * mean(at_high));
}

// Law: turned and moved input gives the same triangles.
TEST(Remesh, FollowsTheInput) {
  const TrianglePatch before = tube_wall(2);
  TrianglePatch moved = before;
  for (Vec3& p : moved.positions) p = Vec3(p.y(), p.z(), p.x()) * 8;  // exact in floating point
  const TrianglePatch plain = remesh(before, nullptr), turned = remesh(moved, nullptr);
  ASSERT_EQ(turned.triangles, plain.triangles);
  for (std::size_t v = 0; v < plain.positions.size(); ++v) {
    const Vec3& p = plain.positions[v];
    EXPECT_LT((turned.positions[v] - Vec3(p.y(), p.z(), p.x()) * 8).norm(), 1e-9);
  }
}

// Three triangles on one edge cannot be remeshed: unchanged rather than with a hole.
TEST(Remesh, NonManifoldPatchStaysAsItIs) {
  const TrianglePatch patch{
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}}, {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}}, 2};
  EXPECT_EQ(remesh(patch, nullptr).triangles, patch.triangles);
}

}  // namespace
}  // namespace skinforge
