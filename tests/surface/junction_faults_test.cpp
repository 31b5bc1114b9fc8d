#include "surface/junction_faults.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "surface/two_cubes.h"

namespace skinforge {
namespace {

using ::testing::IsEmpty;
using testing::TwoCubes;

// A cone over the lower cube's opening with that apex.
TrianglePatch cone(const TwoCubes& cubes, const Vec3& apex) {
  TrianglePatch patch{cubes.loops[0].positions, {}, 4};
  patch.positions.push_back(apex);
  for (int i = 0; i < 4; ++i) patch.triangles.push_back({i, (i + 1) % 4, 4});
  return patch;
}

std::vector<JunctionLoop> lower(const TwoCubes& cubes) {
  return {cubes.loops[0]};
}

TEST(FaultsOf, SoundPatchesHaveNone) {
  const TwoCubes cubes;
  ASSERT_EQ(cubes.loops.size(), 2u);
  EXPECT_FALSE(faults_of(cubes.walls(), cubes.loops, cubes.kept).any());
  EXPECT_FALSE(faults_of(cubes.halved_walls(), cubes.loops, cubes.kept).any());
  EXPECT_FALSE(faults_of(cone(cubes, {0.5, 0.5, 1.3}), lower(cubes), cubes.kept).any());
  EXPECT_THAT(faces_cut_by(cubes.walls(), cubes.loops, cubes.kept), IsEmpty());
}

// The apex hangs out below the bottom: only face 0 of source 0 is cut.
TEST(FaultsOf, PatchThatCutsAKeptFace) {
  const TwoCubes cubes;
  const TrianglePatch patch = cone(cubes, {0.4, 0.45, -0.5});
  EXPECT_GT(faults_of(patch, lower(cubes), cubes.kept).self_intersections, 0u);
  const auto cut = faces_cut_by(patch, lower(cubes), cubes.kept);
  EXPECT_THAT(cut, ::testing::Not(IsEmpty()));
  EXPECT_THAT(cut, ::testing::Each(std::pair(SourceId(0), FaceId(0))));
}

// Faces that were discarded may be cut: the apex lies in the upper cube, beyond the bottom that it lost.
TEST(FaultsOf, DiscardedFacesDoNotCount) {
  const TwoCubes cubes;
  EXPECT_FALSE(faults_of(cone(cubes, {0.5, 0.5, 2.6}), lower(cubes), cubes.kept).any());
}

// A fin on the edge from border vertex 0 to the apex: three triangles there.
TEST(FaultsOf, EdgeWithThreeTriangles) {
  const TwoCubes cubes;
  TrianglePatch patch = cone(cubes, {0.5, 0.5, 1.3});
  patch.positions.emplace_back(-0.5, -0.5, 1.6);
  patch.triangles.push_back({0, 4, 5});
  EXPECT_EQ(faults_of(patch, lower(cubes), cubes.kept).non_manifold_edges, 1u);
}

// A chord that doubles an edge of the preserved mesh: the edge from border vertex 0 to 1 lies on the front
// wall and in two triangles of the patch.
TEST(FaultsOf, ChordOverAPreservedEdge) {
  const TwoCubes cubes;
  TrianglePatch patch = cone(cubes, {0.5, 0.5, 1.3});
  patch.positions.emplace_back(0.5, -0.5, 1.2);
  patch.triangles.push_back({1, 0, 5});
  EXPECT_EQ(faults_of(patch, lower(cubes), cubes.kept).non_manifold_edges, 1u);
}

// The apex on the middle of a border edge leaves that triangle without area.
TEST(FaultsOf, TriangleWithoutArea) {
  const TwoCubes cubes;
  const TrianglePatch patch = cone(cubes, 0.5 * (cubes.loops[0].positions[0] + cubes.loops[0].positions[1]));
  EXPECT_EQ(faults_of(patch, lower(cubes), cubes.kept).degenerate_faces, 1u);
}

// Order by weight: one doubled edge is worse than any number of cuts.
TEST(JunctionFaults, OrderAndWords) {
  const JunctionFaults edge{1, 0, 0}, cuts{0, 9, 0}, flat{0, 0, 9};
  EXPECT_LT(cuts, edge);
  EXPECT_LT(flat, cuts);
  EXPECT_LT(JunctionFaults(), flat);
  JunctionFaults sum = edge;
  sum += cuts;
  sum += flat;
  EXPECT_EQ(describe(sum), "1 non-manifold edges, 9 self-intersections, 9 degenerate faces");
}

}  // namespace
}  // namespace skinforge
