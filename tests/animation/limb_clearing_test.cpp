#include "animation/limb_clearing.h"

#include <gtest/gtest.h>

#include "animation/clearance.h"
#include "animation/sampling.h"
#include "skin_on_joints.h"

namespace skinforge {
namespace {
using namespace testing;

// The scene of the clearance with a thick post and one clip: the arm goes through the post and has no other
// choice.
struct NoOtherChoice : PostAndArm {
  NoOtherChoice() : PostAndArm(0.6) { arm.clips.resize(1); }

  CompletedClip complete(std::size_t input, double clearing = CompletionOptions().clearing) const {
    CompletionOptions options;
    options.clearing = clearing;
    return Mixture({body, arm}, {{GraftKind::Attach, {"root"}, 1, "arm", {}}}, options).complete(input, 0);
  }
};

Quat arm_rotation(const CompletedClip& done, double time) {
  const JointTracks* tracks = tracks_of(done.clip, JointId(2));  // below root and post
  return tracks ? sample(tracks->rotation, time) : Quat::Identity();
}

TEST(LimbClearing, TurnsAnArmThatGoesThroughThePost) {
  NoOtherChoice scene;
  const CompletedClip done = scene.complete(0);
  ASSERT_EQ(done.record.turns.size(), 1U);
  EXPECT_EQ(done.record.turns[0].joint, "arm");
  EXPECT_GT(done.record.turns[0].angle, 0.05);
  EXPECT_LE(done.record.turns[0].angle, CompletionOptions().clearing + 1e-9);
  // The arm pointed along x at the post, which stands at 1.
  const Vec3 along = arm_rotation(done, 0.5) * Vec3::UnitX();
  EXPECT_GT(std::hypot(along.y(), along.z()), 0.15);
}

// Law: one turn for the whole clip, so the arm moves as fast as it did.
TEST(LimbClearing, KeepsTheMotion) {
  NoOtherChoice scene;
  const CompletedClip done = scene.complete(0), as_it_was = scene.complete(0, 0);
  EXPECT_TRUE(as_it_was.record.turns.empty());
  const Quat turn = arm_rotation(done, 0) * arm_rotation(as_it_was, 0).conjugate();
  for (double t = 0; t <= 1; t += 0.1)
    EXPECT_LT((turn * arm_rotation(as_it_was, t)).angularDistance(arm_rotation(done, t)), 1e-3);
}

// Law: what drives the clip stays as it is, however deep it cuts.
TEST(LimbClearing, NeverTurnsTheDrivingPart) {
  NoOtherChoice scene;
  EXPECT_TRUE(scene.complete(1).record.turns.empty());
}

}  // namespace
}  // namespace skinforge
