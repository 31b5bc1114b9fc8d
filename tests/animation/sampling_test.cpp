#include "animation/sampling.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "skeleton/skeletons.h"

namespace skinforge {
namespace {
using namespace testing;
constexpr double kRounding = 1e-14;  // a handful of operations on numbers near 1

const Quat kIdentity = Quat::Identity();
Quat turn_z(double angle_deg) {
  return Quat(Eigen::AngleAxisd(radians(angle_deg), Vec3::UnitZ()));
}

TEST(Sampling, LinearIsClampedAtBothEnds) {
  const Vec3Track track{Interpolation::Linear, {1, 3}, {Vec3(0, 0, 0), Vec3(4, 0, 2)}};
  EXPECT_EQ(sample(track, 0), Vec3(0, 0, 0));
  EXPECT_EQ(sample(track, 1.5), Vec3(1, 0, 0.5));
  EXPECT_EQ(sample(track, 9), Vec3(4, 0, 2));
}

TEST(Sampling, KeysAreGivenBackBitForBit) {
  const Vec3Track track{
      Interpolation::Linear, {0, 0.1, 0.3}, {Vec3(0.1, 0, 0), Vec3(1.0 / 3, 0, 0), Vec3(7, 0, 0)}};
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(sample(track, track.times[k]), track.values[k]);
}

TEST(Sampling, StepHoldsUntilTheNextKey) {
  const Vec3Track track{Interpolation::Step, {0, 1}, {Vec3(1, 0, 0), Vec3(2, 0, 0)}};
  EXPECT_EQ(sample(track, 0.999), Vec3(1, 0, 0));
  EXPECT_EQ(sample(track, 1), Vec3(2, 0, 0));
}

// glTF 2.0 appendix C by hand: values 0 and 0, out-tangent 1 and in-tangent -1 per second over 2 s. At the
// middle the Hermite factors of the tangents are 1/8 and -1/8, times 2 s: 0.25 + 0.25.
TEST(Sampling, CubicSplineTangentsAreScaledByTheInterval) {
  const Vec3 x = Vec3::UnitX(), none = Vec3::Zero();
  const Vec3Track track{Interpolation::CubicSpline, {0, 2}, {none, none, x, -x, none, none}};
  EXPECT_THAT(sample(track, 1), IsNearVec(Vec3(0.5, 0, 0), kRounding));
  EXPECT_EQ(sample(track, 2), none);
}

TEST(Sampling, RotationsTakeTheShortArc) {
  Quat far = turn_z(90);
  far.coeffs() *= -1;  // the same rotation
  const QuatTrack track{Interpolation::Linear, {0, 1}, {kIdentity, far}};
  EXPECT_NEAR(sample(track, 0.5).angularDistance(turn_z(45)), 0, 1e-7);  // acos near 1 keeps half the digits
}

TEST(Sampling, CubicRotationsAreNormalised) {
  const Quat zero(0, 0, 0, 0);
  const QuatTrack track{Interpolation::CubicSpline, {0, 1}, {zero, kIdentity, zero, zero, turn_z(120), zero}};
  const Quat q = sample(track, 0.5);
  EXPECT_NEAR(q.norm(), 1, kRounding);
  EXPECT_NEAR(q.angularDistance(turn_z(60)), 0, 1e-7);
}

TEST(Sampling, WeightsOfMorphs) {
  const WeightsTrack track{Interpolation::Linear, {0, 1}, {{0, 1}, {1, 0}}};
  EXPECT_THAT(sample(track, 0.25), ::testing::ElementsAre(0.25, 0.75));
}

TEST(Sampling, PoseKeepsTheBindValueOfWhatIsNotDriven) {
  const Skeleton chain = straight_chain(2);
  Clip clip{"c", 1, {{JointId(1), {}, {Interpolation::Linear, {0}, {turn_z(30)}}, {}}}, {}};
  const Pose pose = sample(chain, clip, 0.5);
  EXPECT_EQ(pose[1].translation, chain.joints[1].bind.translation);
  EXPECT_EQ(pose[1].rotation.coeffs(), turn_z(30).coeffs());
  EXPECT_EQ(pose[0].rotation.coeffs(), kIdentity.coeffs());
}

TEST(Sampling, EmptyTrackIsABug) {
  EXPECT_THROW(sample(Vec3Track{}, 0), Error);
}

}  // namespace
}  // namespace skinforge
