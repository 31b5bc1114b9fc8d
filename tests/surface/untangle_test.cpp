#include "surface/untangle.h"

#include <gtest/gtest.h>

#include "surface/junction_faults.h"
#include "surface/two_cubes.h"

namespace skinforge {
namespace {

using testing::TwoCubes;

// A cone over the lower cube's opening whose apex hangs out below the bottom comes back to the middle of the
// opening.
TEST(Untangled, AnApexThatCutsComesBackToItsNeighbours) {
  const TwoCubes cubes;
  const std::vector<JunctionLoop> loops = {cubes.loops[0]};
  TrianglePatch patch{loops[0].positions, {}, 4};
  patch.positions.emplace_back(0.4, 0.45, -0.5);
  for (int i = 0; i < 4; ++i) patch.triangles.push_back({i, (i + 1) % 4, 4});
  ASSERT_EQ(intersecting_triangles(patch, loops, cubes.kept).size(), 4u);
  const TrianglePatch result = untangled(patch, loops, cubes.kept);
  EXPECT_EQ(faults_of(result, loops, cubes.kept).self_intersections, 0u);
  Vec3 middle = Vec3::Zero();
  for (const Vec3& p : loops[0].positions) middle += p / 4;
  EXPECT_LT((result.positions[4] - middle).norm(), 1e-12);
  EXPECT_EQ(result.triangles, patch.triangles);
}

TEST(Untangled, ASoundPatchStaysAsItIs) {
  const TwoCubes cubes;
  const TrianglePatch patch = cubes.halved_walls();
  EXPECT_EQ(untangled(patch, cubes.loops, cubes.kept).positions, patch.positions);
}

}  // namespace
}  // namespace skinforge
