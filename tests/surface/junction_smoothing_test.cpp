#include "surface/junction_smoothing.h"

#include <gtest/gtest.h>

#include "surface/two_cubes.h"

namespace skinforge {
namespace {

using testing::TwoCubes;

Junction bulged(const TwoCubes& cubes, double by) {
  Junction junction;
  junction.loops = cubes.loops;
  junction.patch = cubes.halved_walls();
  junction.quads = 8;
  for (std::size_t v = 8; v < 12; ++v)
    junction.patch.positions[v] += by * (junction.patch.positions[v] - Vec3(0.5, 0.5, 1.5));
  return junction;
}

// By hand: half of the way to the mean of two neighbours in the ring and one on either border.
TEST(JunctionSmoothing, OneRoundByHand) {
  const TwoCubes cubes;
  Junction junction = bulged(cubes, 0.2);
  const Vec3 before = junction.patch.positions[8];
  Vec3 mean = Vec3::Zero();
  for (const std::size_t n : {9u, 11u, 0u, 4u}) mean += junction.patch.positions[n] / 4;
  EXPECT_EQ(smooth_junction(junction, cubes.kept, 1), 1);
  EXPECT_LT((junction.patch.positions[8] - (before + mean) / 2).norm(), 1e-12);
  EXPECT_FALSE(junction.faults.any());
}

TEST(JunctionSmoothing, BordersStay) {
  const TwoCubes cubes;
  Junction junction = bulged(cubes, 0.2);
  const std::vector<Vec3> before = junction.patch.positions;
  smooth_junction(junction, cubes.kept, 10);
  for (std::size_t v = 0; v < junction.patch.fixed; ++v) EXPECT_EQ(junction.patch.positions[v], before[v]);
}

TEST(JunctionSmoothing, NoRoundsNothingChanges) {
  const TwoCubes cubes;
  Junction junction = bulged(cubes, 0.2);
  const std::vector<Vec3> before = junction.patch.positions;
  EXPECT_EQ(smooth_junction(junction, cubes.kept, 0), 0);
  EXPECT_EQ(junction.patch.positions, before);
}

}  // namespace
}  // namespace skinforge
