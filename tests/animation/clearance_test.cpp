#include "animation/clearance.h"

#include <gtest/gtest.h>

#include <cmath>

#include "animation/skin_balls.h"
#include "characters.h"
#include "skin_on_joints.h"

namespace skinforge {
namespace {
using namespace testing;

// By hand: a limb 1 long and 0.1 thick gets four balls of 0.08 at 1/8, 3/8, 5/8 and 7/8 of its length, and
// four small ones, half as thick, at its ends, whose rims are 0.06 away from those.
TEST(SkinBalls, LieAlongTheLimb) {
  Character limb;
  limb.skeleton = straight_chain(1);
  add_limb(limb, JointId(0), 1);
  const std::vector<JointId> joints = {JointId(0)};
  const auto balls = skin_balls(limb, joints);
  ASSERT_EQ(balls.size(), 8U);
  double along = 0;
  for (std::size_t b = 4; b < 8; ++b) {
    EXPECT_NEAR(balls[b].radius, 0.04, 1e-9);
    EXPECT_NEAR(std::abs(balls[b].center.x() - 0.5), 0.5, 1e-9);
    EXPECT_NEAR(Vec3(0, balls[b].center.y(), balls[b].center.z()).norm(), 0.05, 1e-9);
  }
  for (const SkinBall& ball : std::span(balls).first(4)) {
    EXPECT_NEAR(ball.radius, 0.08, 1e-9);
    EXPECT_NEAR(Vec3(0, ball.center.y(), ball.center.z()).norm(), 0, 1e-9);
    along += ball.center.x();
  }
  EXPECT_NEAR(along, 0.125 + 0.375 + 0.625 + 0.875, 1e-9);
}

TEST(Clearance, IsDeepWhereTheArmGoesThroughThePost) {
  PostAndArm scene;
  const Mixture m({scene.body, scene.arm}, {{GraftKind::Attach, {"root"}, 1, "arm", {}}});
  std::vector<const MotionSet*> motions = {&m.motions[0], &m.motions[1]};
  const CompletionOptions options;
  const Casting casting = cast_sources(m.pointers, m.graft, 0, 0, options);
  ASSERT_EQ(casting.parts.size(), 1U);
  const Clearance clearance(seams_between(m.pointers, m.graft, motions, casting.driver, casting.parts[0]), 0,
                            1);
  const std::size_t frames = m.motions[1].poses.size();
  const auto through = static_cast<std::size_t>(m.motions[1].clip_begin[0]),
             beside = static_cast<std::size_t>(m.motions[1].clip_begin[1]);
  EXPECT_GT(clearance.depth(0, through), 0.01);
  EXPECT_EQ(clearance.depth(0, beside), 0);
  const Eigen::ArrayXf depths = clearance.depths(0, frames, 1);
  for (std::size_t c = 0; c < frames; ++c)
    EXPECT_NEAR(depths[static_cast<Eigen::Index>(c)], clearance.depth(0, c), 1e-6);
}

// Law: nothing that cuts is shown where something does not.
TEST(Clearance, IsSoughtByTheCompletion) {
  PostAndArm scene;
  const Mixture m({scene.body, scene.arm}, {{GraftKind::Attach, {"root"}, 1, "arm", {}}});
  for (const auto& choice : m.complete(0, 0).record.choices) EXPECT_EQ(choice.clip, "Beside");
}

}  // namespace
}  // namespace skinforge
