#include "animation/keyframe_distance.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "characters.h"

namespace skinforge {
namespace {
using namespace testing;
constexpr float kFloat = 1e-5F;  // sums of a hundred floats near 1

// A motion set of one result joint whose frames turn about z by the given angles.
MotionSet turning(const std::vector<double>& angles_deg, bool cyclic = false) {
  MotionSet set;
  for (const double angle : angles_deg) {
    set.poses.push_back(Pose(1));
    set.frame_time.push_back(0);
    const Quat q(Eigen::AngleAxisd(radians(angle), Vec3::UnitZ()));
    for (int k = 0; k < 4; ++k) set.rotations.push_back(static_cast<float>(q.coeffs()[k]));
  }
  set.clip_begin.push_back(static_cast<std::int32_t>(angles_deg.size()));
  set.confidence = {1};
  set.is_cyclic = {cyclic};
  set.is_moving = {true};
  return set;
}

// By hand: two rotations that differ by 120 degrees have |q . q'| = cos 60 degrees = 1/2; by 240 degrees the
// same.
TEST(KeyframeDistance, ByHand) {
  const MotionSet driver = turning({0}), candidate = turning({0, 120, 240, 180});
  const std::vector<MotionPair> pairs = {{&driver, &candidate}};
  const DistanceTable table = keyframe_distances(pairs, 0, 1);
  EXPECT_NEAR(table.row(0)[0], 0, kFloat);
  EXPECT_NEAR(table.row(0)[1], 0.5, kFloat);
  EXPECT_NEAR(table.row(0)[2], 0.5, kFloat);
  EXPECT_NEAR(table.row(0)[3], 1, kFloat);
}

// Two joints, equal in one and 180 degrees apart in the other, which counts half: 1 * 0.5 / 1.5.
TEST(KeyframeDistance, JointsWeighByTheirConfidences) {
  MotionSet driver = turning({0}), candidate = turning({0});
  driver.rotations.insert(driver.rotations.end(), {0, 0, 0, 1});
  candidate.rotations.insert(candidate.rotations.end(), {0, 0, 1, 0});
  driver.confidence = {1, 0.5};
  candidate.confidence = {1, 3};  // several joints on one image: counts as 1
  const std::vector<MotionPair> pairs = {{&driver, &candidate}};
  EXPECT_NEAR(keyframe_distances(pairs, 0, 1).row(0)[0], 0.5 / 1.5, kFloat);
  candidate.confidence = {1, 0};  // reached by one side only: left out
  EXPECT_NEAR(keyframe_distances(pairs, 0, 1).row(0)[0], 0, kFloat);
}

TEST(KeyframeDistance, NothingInCommonIsNoDistance) {
  MotionSet driver = turning({0}), candidate = turning({120});
  candidate.confidence = {0};
  const std::vector<MotionPair> pairs = {{&driver, &candidate}};
  EXPECT_EQ(keyframe_distances(pairs, 0, 1).row(0)[0], 0);
}

// Sec. 8.1 by hand: at the middle of three frames the neighbours are 1 and 2 steps away; 0.2 and 0.1 weigh
// against 1. Distances along the diagonal of time: 0 at the middle, 0.5 before and after; the second step
// holds the ends.
TEST(KeyframeDistance, WindowAddsNeighbours) {
  DistanceTable table{3, 3, {0.5F, 1, 1, 1, 0, 1, 1, 1, 0.5F}, {}, {}};
  const MotionSet set = turning({0, 0, 0});
  const FrameSteps steps = frame_steps(set);
  EXPECT_NEAR(windowed(table, steps, steps).row(1)[1], (0.2 * (0.5 + 0.5) + 0.1 * (0.5 + 0.5)) / 1.6, kFloat);
}

TEST(FrameSteps, LoopsSkipTheirRepeatedEnd) {
  const FrameSteps open = frame_steps(turning({0, 1, 2, 3}));
  EXPECT_THAT(open.next, ::testing::ElementsAre(1, 2, 3, -1));
  EXPECT_THAT(open.previous, ::testing::ElementsAre(-1, 0, 1, 2));
  const FrameSteps loop = frame_steps(turning({0, 1, 2, 0}, true));
  EXPECT_THAT(loop.next, ::testing::ElementsAre(1, 2, 0, 1));
  EXPECT_THAT(loop.previous, ::testing::ElementsAre(2, 0, 1, 2));
}

// Law: signs of quaternions do not matter; more candidates than one block are compared alike.
TEST(KeyframeDistance, SignsDoNotMatter) {
  std::vector<double> angles;
  for (int k = 0; k < 21; ++k) angles.push_back(17.0 * k);
  const MotionSet driver = turning({40});
  MotionSet candidate = turning(angles);
  const std::vector<MotionPair> pairs = {{&driver, &candidate}};
  const auto before = keyframe_distances(pairs, 0, 1).values;
  for (std::size_t k = 0; k < candidate.rotations.size(); ++k)
    if (k / 4 % 2 == 1) candidate.rotations[k] *= -1;
  EXPECT_EQ(keyframe_distances(pairs, 0, 1).values, before);
  for (std::size_t k = 0; k < 21; ++k)
    EXPECT_NEAR(before[k], 1 - std::abs(std::cos(radians(angles[k] - 40) / 2)), kFloat);
}

}  // namespace
}  // namespace skinforge
