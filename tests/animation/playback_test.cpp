#include "animation/playback.h"

#include <gtest/gtest.h>

#include "skeleton/skeletons.h"

namespace skinforge {
namespace {
using namespace testing;
constexpr double kRounding = 1e-9;  // two dozen means of numbers below 100

// One joint that moves along x by one unit a frame; two clips of `count` frames, the second 100 units away.
MotionSet two_clips(std::int32_t count, bool cyclic) {
  MotionSet set;
  for (int clip = 0; clip < 2; ++clip)
    for (int f = 0; f < count; ++f) {
      Transform t;
      t.translation.x() = 100 * clip + f;
      set.poses.push_back({t});
    }
  set.clip_begin = {0, count, 2 * count};
  set.is_cyclic = {cyclic, cyclic};
  return set;
}

// Where the joint is: no position of these tests is past the end of its clip.
double x_of(const PlaybackFrame& frame) {
  const auto at = [](const ClipPosition& p) { return 100 * static_cast<double>(p.clip) + p.frame; };
  return (1 - frame.blend) * at(frame.from) + frame.blend * at(frame.to);
}

TEST(Playback, UntouchedPathPlaysAsItIs) {
  const MotionSet set = two_clips(10, false);
  const KeyframePath path{{3, 4, 5, 6}, std::vector(4, PathStep::Next)};
  const auto frames = play(path, set, false, 4);
  for (std::size_t f = 0; f < 4; ++f) EXPECT_NEAR(x_of(frames[f]), 3 + static_cast<double>(f), kRounding);
}

// A hold in the middle becomes a slower stretch: always onward, at most one frame at a time.
TEST(Playback, HoldsAreEvenedOut) {
  const MotionSet set = two_clips(30, false);
  KeyframePath path;
  for (int f = 0; f < 21; ++f) {
    path.candidates.push_back(f < 11 ? f : f - 1);
    path.steps.push_back(f == 11 ? PathStep::Hold : PathStep::Next);
  }
  const auto frames = play(path, set, false, 4);
  for (std::size_t f = 1; f < frames.size(); ++f) {
    const double step = frames[f].from.frame - frames[f - 1].from.frame;
    EXPECT_GT(step, 0.5);
    EXPECT_LE(step, 1 + kRounding);
  }
  EXPECT_NEAR(frames.back().from.frame, 19, kRounding);
}

// By hand: a ring of 4 frames over a loop of 5 takes steps of 5/4 once evened out.
TEST(Playback, RingsRunAtASteadySpeed) {
  MotionSet set = two_clips(6, true);
  const KeyframePath path{{0, 1, 2, 4}, {PathStep::Next, PathStep::Next, PathStep::Next, PathStep::Skip}};
  const auto frames = play(path, set, true, 4);
  for (std::size_t f = 1; f < 4; ++f)
    EXPECT_NEAR(frames[f].from.frame - frames[f - 1].from.frame, 1.25, 0.01);
}

// By hand: a jump half way, faded over two frames to either side: shares 1/8, 3/8, 5/8, 7/8 through 3x^2 -
// 2x^3.
TEST(Playback, JumpsAreCrossfaded) {
  const MotionSet set = two_clips(10, false);
  const KeyframePath path{{0, 1, 2, 3, 14, 15, 16, 17},
                          {PathStep::Next, PathStep::Next, PathStep::Next, PathStep::Next, PathStep::Jump,
                           PathStep::Next, PathStep::Next, PathStep::Next}};
  const auto frames = play(path, set, false, 2);
  EXPECT_EQ(frames[1].blend, 0);
  EXPECT_NEAR(frames[2].blend, 3.0 / 64 - 2.0 / 512, kRounding);
  EXPECT_NEAR(frames[5].blend, 1 - frames[2].blend, kRounding);
  const double x = x_of(frames[3]);
  EXPECT_NEAR(x, (1 - frames[3].blend) * 3 + frames[3].blend * 103, kRounding);
}

double largest_turn(const std::vector<Quat>& rotations, bool is_loop) {
  double largest = is_loop ? rotations.back().angularDistance(rotations.front()) : 0;
  for (std::size_t k = 1; k < rotations.size(); ++k)
    largest = std::max(largest, rotations[k].angularDistance(rotations[k - 1]));
  return largest;
}

// Law: whatever comes in, no two neighbours stay further apart than the limit.
TEST(LimitTurns, HoldsForRandomRotations) {
  std::mt19937 random(1);
  for (const bool is_loop : {false, true})
    for (const double limit : {1.0, 0.2, 0.01, 1e-6, 0.0}) {
      std::vector<Quat> rotations;
      for (int k = 0; k < 60; ++k) rotations.push_back(random_rotation(random));
      limit_turns(rotations, limit, is_loop);
      EXPECT_LE(largest_turn(rotations, is_loop), limit + 1e-7)
          << limit;  // acos near 1 keeps half the digits
    }
}

TEST(LimitTurns, SlowRotationsKeepEveryBit) {
  std::vector<Quat> rotations;
  for (int k = 0; k < 20; ++k) rotations.push_back(Quat(Eigen::AngleAxisd(0.1 * k, Vec3::UnitY())));
  const auto before = rotations;
  limit_turns(rotations, 0.11, false);
  for (std::size_t k = 0; k < 20; ++k) EXPECT_EQ(rotations[k].coeffs(), before[k].coeffs());
}

// By hand: one jump of 90 degrees with a limit of 40 spreads over its neighbours; the far ends stay.
TEST(LimitTurns, SpreadsAJump) {
  std::vector<Quat> rotations(20, Quat::Identity());
  for (std::size_t k = 10; k < 20; ++k) rotations[k] = Quat(Eigen::AngleAxisd(radians(90), Vec3::UnitX()));
  limit_turns(rotations, radians(40), false);
  EXPECT_LE(largest_turn(rotations, false), radians(40));
  EXPECT_EQ(rotations[0].coeffs(), Quat::Identity().coeffs());
  EXPECT_NEAR(rotations[19].angularDistance(Quat::Identity()), radians(90), 1e-7);
}

}  // namespace
}  // namespace skinforge
