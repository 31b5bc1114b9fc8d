#include "animation/limbs.h"

#include <gtest/gtest.h>

#include <cmath>

#include "animation/sampling.h"
#include "characters.h"

namespace skinforge {
namespace {
using namespace testing;

Character walker() {
  return swinging_character(random_skeleton(12, 1, "j"),
                            {{"Walk", 2.0, 0.5, 2, 1}, {"Die", 1.0, 0.9, 0.3, 2}});
}

// By hand: the walk has two cycles of one second, 30 frames each.
TEST(Limbs, FindTheStep) {
  const Mixture m({walker(), walker()}, {{GraftKind::Attach, {"j1"}, 1, "j4", {}}});
  ASSERT_TRUE(m.motions[0].is_cyclic[0]);
  EXPECT_EQ(step_frames(m.motions[0], 0, true), 30);
  EXPECT_EQ(step_frames(m.motions[0], 1, false), 12);  // no gait
}

TEST(Limbs, RankThoseOfTheSameNames) {
  Character other = walker();
  for (Joint& joint : other.skeleton.joints) joint.name += "_x";
  const Mixture m({walker(), walker(), other}, {{GraftKind::Attach, {"j1"}, 1, "j4", {}},
                                                {GraftKind::Attach, {"j2"}, 1, "j4", {}},
                                                {GraftKind::Attach, {"j2"}, 2, "j4_x", {}}});
  const auto ranks = limb_ranks(m.pointers, m.graft);
  ASSERT_EQ(ranks.size(), 4U);
  const std::vector<std::size_t> families = {0, 0, 0, 3}, order = {0, 1, 2, 0}, counts = {3, 3, 3, 1};
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(ranks[k].family, families[k]);
    EXPECT_EQ(ranks[k].rank, order[k]);
    EXPECT_EQ(ranks[k].count, counts[k]);
  }
  EXPECT_DOUBLE_EQ(steps_behind(ranks[2], ranks[0], {}), 2.0 / 3);
  EXPECT_DOUBLE_EQ(steps_behind(ranks[0], ranks[1], {}), -1.0 / 3);
  EXPECT_EQ(steps_behind(ranks[3], ranks[0], {}), 0);
  EXPECT_EQ(steps_behind(ranks[1], ranks[0], 0), 0);
}

// Law: begins and ends with the body, never stands still or runs back, and is as late in between as wanted.
TEST(Limbs, FollowLate) {
  double before = delayed_frame(0, 6, 100, false);
  EXPECT_EQ(before, 0);
  for (int f = 1; f <= 100; ++f) {
    const double now = delayed_frame(f, 6, 100, false);
    EXPECT_GT(now - before, 0.6);
    EXPECT_LT(now - before, 1.4);
    before = now;
  }
  EXPECT_EQ(before, 100);
  EXPECT_DOUBLE_EQ(delayed_frame(50, 6, 100, false), 44);
  EXPECT_DOUBLE_EQ(delayed_frame(50, 6, 100, true), 44);
  EXPECT_GT(delayed_frame(5, 6, 10, false), 3);  // a short clip leaves no time for it
}

// The second arms of an input that comes twice: the first keep their keys, the others do the same half a step
// later, and in lockstep when asked.
TEST(Limbs, FromTheSameInputMoveHalfAStepLater) {
  CompletionOptions options;
  const std::vector<GraftOperation> attach = {{GraftKind::Attach, {"j1"}, 0, "j4", {}}};
  const Mixture apart({walker()}, attach, options);
  options.limb_phase = 0;
  const Mixture alike({walker()}, attach, options);
  const Clip& source = apart.inputs[0].clips[0];
  JointId joint;  // one below the topmost of the second limb
  for (std::size_t j = 5; j < 12; ++j)
    if (apart.graft.sources[1].result_joint[j].is_valid()) joint = JointId(j);
  ASSERT_TRUE(joint.is_valid());
  const JointId first = apart.graft.sources[0].result_joint[joint.index()],
                second = apart.graft.sources[1].result_joint[joint.index()];
  const QuatTrack& wanted = tracks_of(source, joint)->rotation;
  const Clip later = apart.complete(0, 0).clip, same = alike.complete(0, 0).clip;
  for (const double time : {0.1, 0.45, 1.3}) {
    const auto at = [&](const Clip& clip, JointId j) { return sample(tracks_of(clip, j)->rotation, time); };
    EXPECT_LT(at(later, first).angularDistance(sample(wanted, time)), 1e-9);
    EXPECT_LT(at(same, second).angularDistance(sample(wanted, time)), 1e-9);
    EXPECT_LT(at(later, second).angularDistance(sample(wanted, std::fmod(time + 1.5, 2))),
              0.02);  // resampled
  }
}

}  // namespace
}  // namespace skinforge
