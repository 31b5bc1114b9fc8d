#include "animation/limb_problem.h"

#include <gtest/gtest.h>

#include <numbers>

#include "skeleton/rotations.h"

namespace skinforge {
namespace {

// By hand: a ball 1 along x and an obstacle 0.1 above it that it may come no nearer than 0.3: it has to turn
// down by 2 asin(0.15 / 1) less the 0.1 that they are apart.
std::vector<LimbPair> one_ball() {
  return {{Vec3(1, 0, 0), Vec3(std::cos(0.1), std::sin(0.1), 0), 0.3}};
}

TEST(LimbProblem, SaysHowDeepItCuts) {
  const double apart = 2 * std::sin(0.05);
  EXPECT_NEAR(cut_of(one_ball(), Quat::Identity()).deepest, 0.3 - apart, 1e-12);
  EXPECT_NEAR(cut_of(one_ball(), Quat::Identity()).squares, (0.3 - apart) * (0.3 - apart), 1e-12);
  EXPECT_EQ(cut_of(one_ball(), Quat(Eigen::AngleAxisd(-1, Vec3::UnitZ()))).deepest, 0);
}

TEST(LimbProblem, TurnsTheLimbAwayAndNoFartherThanNeeded) {
  const Quat turn = clearing_turn(one_ball(), 1);
  EXPECT_LT(cut_of(one_ball(), turn).deepest, 0.003);  // of 0.2
  const Vec3 vector = rotation_vector(turn);
  EXPECT_NEAR(vector.z(), -(2 * std::asin(0.15) - 0.1), 0.02);
  EXPECT_NEAR(vector.x(), 0, 1e-9);
  EXPECT_NEAR(vector.y(), 0, 1e-9);
}

TEST(LimbProblem, TurnsByNoMoreThanIsAllowed) {
  const Quat turn = clearing_turn(one_ball(), 0.05);
  EXPECT_NEAR(turn.angularDistance(Quat::Identity()), 0.05, 1e-9);
}

// By hand: at 0.1 radians from it, and nearer than 0.05 only once turned.
TEST(LimbProblem, KnowsWhatATurnCannotBringTogether) {
  const LimbPair pair{Vec3(1, 0, 0), Vec3(std::cos(0.5), std::sin(0.5), 0), 0.05};
  EXPECT_TRUE(may_meet(pair, 0.5));
  EXPECT_FALSE(may_meet(pair, 0.4));
}

// Law: what is clear stays.
TEST(LimbProblem, LeavesAClearLimbAlone) {
  std::vector<LimbPair> clear = one_ball();
  clear[0].touching = 0.05;
  EXPECT_EQ(clearing_turn(clear, 1).coeffs(), Quat::Identity().coeffs());
}

// Law: turning the whole scene turns the answer.
TEST(LimbProblem, DoesNotDependOnTheFrame) {
  const Vec3 obstacle(0.9, 0.05, 0.1);
  const std::vector<LimbPair> pairs = {{Vec3(1, 0, 0), obstacle, 0.2}, {Vec3(0.8, 0, 0), obstacle, 0.17}};
  const Quat scene = from_rotation_vector(Vec3(0.3, -1.1, 0.7));
  std::vector<LimbPair> turned;
  for (const LimbPair& p : pairs) turned.push_back({scene * p.ball, scene * p.obstacle, p.touching});
  const Quat turn = clearing_turn(pairs, 1);
  EXPECT_LT(cut_of(pairs, turn).deepest, 0.003);
  EXPECT_LT((scene * turn * scene.conjugate()).angularDistance(clearing_turn(turned, 1)), 1e-6);
}

}  // namespace
}  // namespace skinforge
