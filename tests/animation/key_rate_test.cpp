#include "animation/key_rate.h"

#include <gtest/gtest.h>

#include <numbers>

namespace skinforge {
namespace {

Clip keyed_at(std::vector<double> times) {
  JointTracks tracks;
  tracks.joint = JointId(0);
  tracks.rotation.times = std::move(times);
  tracks.rotation.values.assign(tracks.rotation.times.size(), Quat::Identity());
  return {"clip", tracks.rotation.times.back(), {tracks}, {}};
}

std::vector<double> steps(int count, double step) {
  std::vector<double> times;
  for (int k = 0; k < count; ++k) times.push_back(static_cast<float>(step * k));
  return times;
}

TEST(OwnKeyRate, IsThatOfEqualSteps) {
  EXPECT_NEAR(own_key_rate(keyed_at(steps(25, 1.0 / 24))).value(), 24, 1e-3);
  EXPECT_NEAR(own_key_rate(keyed_at(steps(25, 1.0 / 60))).value(), 60, 1e-2);
  auto times = steps(30, 1.0 / 24);
  times.back() += 0.16;  // as the fox's Run ends
  EXPECT_NEAR(own_key_rate(keyed_at(times)).value(), 24, 1e-3);
}

TEST(OwnKeyRate, IsNoneForFewUnevenSlowAndFastKeys) {
  EXPECT_FALSE(own_key_rate(keyed_at(steps(3, 1.0 / 24))));
  EXPECT_FALSE(own_key_rate(keyed_at({0, 0.1, 0.4, 0.5, 0.9, 1})));
  EXPECT_FALSE(own_key_rate(keyed_at(steps(10, 1.0 / 5))));
  EXPECT_FALSE(own_key_rate(keyed_at(steps(10, 1.0 / 500))));
  EXPECT_FALSE(own_key_rate(Clip{}));
}

// By hand: a quarter turn in a tenth of a second; the jump between two keys a millisecond apart is no turn.
TEST(FastestKeyedTurn, IsTheFastestStepBetweenKeys) {
  Clip clip = keyed_at({0, 0.1, 0.101, 1});
  const Quat quarter(Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitZ()));
  clip.joints[0].rotation.values = {Quat::Identity(), quarter, Quat::Identity(), Quat::Identity()};
  EXPECT_NEAR(fastest_keyed_turn(clip), 10 * std::numbers::pi / 2, 1e-9);
  clip.joints[0].rotation.interpolation = Interpolation::Step;
  EXPECT_EQ(fastest_keyed_turn(clip), 0);
}

}  // namespace
}  // namespace skinforge
