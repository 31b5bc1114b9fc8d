#include "animation/clip_player.h"

#include <gtest/gtest.h>

#include "animation/sampling.h"
#include "characters.h"

namespace skinforge {
namespace {
using namespace testing;
constexpr double kRounding = 1e-9;

// One joint that goes along x by 30 units a second for a second, from 0 and from 100 on: 31 frames each.
struct TwoClips {
  Character input;
  MotionSet set;

  explicit TwoClips(bool cyclic) {
    input.skeleton = make_skeleton({{"root"}});
    for (int c = 0; c < 2; ++c) {
      JointTracks tracks;
      tracks.joint = JointId(0);
      tracks.translation = {Interpolation::Linear, {0, 1}, {Vec3(100 * c, 0, 0), Vec3(100 * c + 30, 0, 0)}};
      input.clips.push_back({"clip", 1, {tracks}, {}});
      for (int f = 0; f <= 30; ++f) {
        set.poses.push_back({input.skeleton.joints[0].bind});
        set.poses.back()[0].translation.x() = 100 * c + f;
      }
    }
    set.clip_begin = {0, 31, 62};
    set.is_cyclic = {cyclic, cyclic};
  }
  double x(const ClipPosition& position) {
    return ClipPlayer(input, set).at(position, JointId(0)).translation.x();
  }
};

TEST(ClipPlayer, PlaysFramesOfTheSetAsTheyAre) {
  TwoClips clips(false);
  clips.set.poses[7][0].translation.x() = 55;  // not what the clip says
  EXPECT_EQ(clips.x({0, 7}), 55);
  EXPECT_NEAR(clips.x({0, 7.5}), 7.5, kRounding);
}

TEST(ClipPlayer, HoldsAtTheEndsOfWhatIsNoLoop) {
  TwoClips clips(false);
  EXPECT_NEAR(clips.x({1, -0.5}), 100, kRounding);
  EXPECT_NEAR(clips.x({1, 99}), 130, kRounding);
}

// By hand: the ends of a loop are 30 apart, so a quarter into it the joint is 0.25 * 30 nearer to its end.
TEST(ClipPlayer, WrapsInLoopsAndClosesThem) {
  TwoClips clips(true);
  EXPECT_NEAR(clips.x({0, 7.5}), 7.5 + 0.25 * 30, kRounding);
  EXPECT_NEAR(clips.x({0, 37.5}), 7.5 + 0.25 * 30, kRounding);
  EXPECT_NEAR(clips.x({1, -22.5}), 107.5 + 0.25 * 30, kRounding);
}

TEST(ClipPlayer, PlaysOnBetweenFramesAndBlendsAcrossClips) {
  TwoClips clips(true);
  ClipPlayer player(clips.input, clips.set);
  const auto frame = [](std::size_t clip, double f) { return PlaybackFrame{{clip, f}, {clip, f}, 0}; };
  const auto x = [&](const PlaybackFrame& a, const PlaybackFrame& b) {
    return player.between(a, b, 0.5, JointId(0)).translation.x();
  };
  EXPECT_NEAR(x(frame(0, 7), frame(0, 8)), clips.x({0, 7.5}), kRounding);
  EXPECT_NEAR(x(frame(0, 29), frame(0, 0)), clips.x({0, 29.5}), kRounding);
  EXPECT_NEAR(x(frame(0, 4), frame(1, 8)), (clips.x({0, 4}) + clips.x({1, 8})) / 2, kRounding);
}

// Law: wherever a clip is played at its own tempo, that is what its keys say, whatever lies on the frames.
TEST(ClipPlayer, PlaysWhatTheKeysSay) {
  const Mixture m({swinging_character(random_skeleton(9, 3, "j"), {{"Swing", 1.3, 0.7, 1.5, 4}}),
                   swinging_character(random_skeleton(5, 4, "k"), {{"Swing", 1, 0.3, 1, 5}})},
                  {{GraftKind::Attach, {"j0"}, 1, "k1", {}}});
  const MotionSet& set = m.motions[0];
  ASSERT_FALSE(set.is_cyclic[0]);
  ClipPlayer player(m.inputs[0], set);
  const Clip& clip = m.inputs[0].clips[0];
  const double last = set.clip_begin[1] - 1;
  for (double frame = 0; frame <= last; frame += 0.37)
    for (const JointTracks& tracks : clip.joints)
      EXPECT_LT(player.at(ClipPosition{0, frame}, tracks.joint)
                    .rotation.angularDistance(sample(tracks.rotation, clip.duration * frame / last)),
                1e-7);
}

}  // namespace
}  // namespace skinforge
