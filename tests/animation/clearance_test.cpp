#include "animation/clearance.h"

#include <gtest/gtest.h>

#include <cmath>

#include "characters.h"

namespace skinforge {
namespace {
using namespace testing;

// Rings of skin of radius 0.1 along the x axis of a joint, from its origin to `length`.
void add_limb(Character& character, JointId joint, double length) {
  const Affine3 model_from_joint = character.skeleton[joint].joint_from_model.inverse();
  for (int ring = 0; ring <= 8; ++ring)
    for (int side = 0; side < 8; ++side) {
      const double angle = 2 * std::numbers::pi * side / 8;
      character.mesh.positions.push_back(
          model_from_joint * Vec3(length * ring / 8, 0.1 * std::cos(angle), 0.1 * std::sin(angle)));
      character.weights.push_row(std::vector<Influence>{{joint, 1.0}});
    }
}

Clip turned(const std::string& name, JointId joint, double angle) {
  JointTracks tracks;
  tracks.joint = joint;
  for (int k = 0; k <= 10; ++k) {
    tracks.rotation.times.push_back(0.1 * k);
    tracks.rotation.values.push_back(
        Quat(Eigen::AngleAxisd(angle + 0.01 * std::sin(0.628318530718 * k), Vec3::UnitY())));
  }
  return {name, 1, {tracks}, {}};
}

// By hand: a limb 1 long and 0.1 thick gets four balls of 0.08 at 1/8, 3/8, 5/8 and 7/8 of its length.
TEST(SkinBalls, LieAlongTheLimb) {
  Character limb;
  limb.skeleton = straight_chain(1);
  add_limb(limb, JointId(0), 1);
  const std::vector<JointId> joints = {JointId(0)};
  const auto balls = skin_balls(limb, joints);
  ASSERT_EQ(balls.size(), 4U);
  double along = 0;
  for (const SkinBall& ball : balls) {
    EXPECT_NEAR(ball.radius, 0.08, 1e-9);
    EXPECT_NEAR(Vec3(0, ball.center.y(), ball.center.z()).norm(), 0, 1e-9);
    along += ball.center.x();
  }
  EXPECT_NEAR(along, 0.125 + 0.375 + 0.625 + 0.875, 1e-9);
}

// A post along z at x = 1 belongs to the body; an arm of length 1.5 along x hangs at its root, and its bind
// pose points up, clear of the post. Turned by 0 about y it goes through the post, turned by -1.2 it does
// not.
struct PostAndArm {
  Character body, arm;
  PostAndArm() {
    body.skeleton = make_skeleton(
        {{"root"}, {"post", 0, Vec3(1, 0, 0), Quat(Eigen::AngleAxisd(-1.5708, Vec3::UnitY()))}});
    add_limb(body, JointId(1), 0.6);
    body.clips = {turned("Stand", JointId(0), 0)};
    arm.skeleton =
        make_skeleton({{"hip"}, {"arm", 0, Vec3::Zero(), Quat(Eigen::AngleAxisd(-1.5708, Vec3::UnitY()))}});
    add_limb(arm, JointId(1), 1.5);
    arm.clips = {turned("Through", JointId(1), 0), turned("Beside", JointId(1), -1.2)};
  }
};

TEST(Clearance, IsDeepWhereTheArmGoesThroughThePost) {
  PostAndArm scene;
  const Mixture m({scene.body, scene.arm}, {{GraftKind::Attach, {"root"}, 1, "arm", {}}});
  std::vector<const MotionSet*> motions = {&m.motions[0], &m.motions[1]};
  const CompletionOptions options;
  const Casting casting = cast_sources(m.pointers, m.graft, 0, 0, options);
  ASSERT_EQ(casting.parts.size(), 1U);
  const std::vector<bool> all(m.motions[1].poses.size(), true);
  const Clearance clearance(m.pointers, m.graft, motions, casting.driver, casting.parts[0], {0, 1, all});
  const auto through = static_cast<std::size_t>(m.motions[1].clip_begin[0]),
             beside = static_cast<std::size_t>(m.motions[1].clip_begin[1]);
  EXPECT_GT(clearance.depth(0, through), 0.01);
  EXPECT_EQ(clearance.depth(0, beside), 0);
  const Eigen::ArrayXf depths = clearance.depths(0);
  for (std::size_t c = 0; c < all.size(); ++c)
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
