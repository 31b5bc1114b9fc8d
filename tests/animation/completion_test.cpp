#include "animation/completion.h"

#include <gtest/gtest.h>

#include <set>

#include "animation/resampling.h"
#include "animation/sampling.h"
#include "characters.h"

namespace skinforge {
namespace {
using namespace testing;

const Similarity kPlacement{0.5, Quat(Eigen::AngleAxisd(radians(-90), Vec3::UnitY())), Vec3(1, 2, 3)};
const std::vector<GraftOperation> kReplace = {{GraftKind::Replace, {"h7"}, 1, "d4", kPlacement}};
const std::vector<GraftOperation> kAttachTwo = {{GraftKind::Attach, {"h3"}, 1, "d4", kPlacement},
                                                {GraftKind::Attach, {"h2"}, 1, "d5", kPlacement}};

Character host() {
  return swinging_character(random_skeleton(16, 1, "h"),
                            {{"Walk", 1.0, 0.4, 1, 1}, {"Die", 1.4, 0.9, 0.3, 2}});
}
Character donor() {
  return swinging_character(random_skeleton(14, 2, "d"),
                            {{"Run", 0.7, 0.6, 1, 3}, {"Idle", 2.0, 0.1, 1, 4}, {"Hit", 0.9, 0.8, 0.4, 5}});
}

// The driving part moves as in its source at any time: each of its joints relative to its parent is change *
// source.
TEST(CompleteClip, DrivingPartFollowsItsSource) {
  const Mixture m({host(), donor()}, kReplace);
  for (std::size_t input = 0; input < 2; ++input) {
    const Clip clip = m.complete(input, 0).clip;
    for (const double time : {0.0, 0.123, 0.5, 0.7}) {
      const Pose result = sample(m.graft.skeleton, clip, time);
      const Pose source = sample(m.inputs[input].skeleton, m.inputs[input].clips[0], time);
      for (std::size_t j = 0; j < result.size(); ++j) {
        const JointOrigin& origin = m.graft.origins[j];
        if (m.graft.sources[origin.source.index()].input != input) continue;
        const Affine3 expected = origin.change.matrix() * source[origin.joint.index()].matrix();
        EXPECT_LT(difference(result[j].matrix(), expected), 1e-12);  // one product of quaternions
      }
    }
  }
}

TEST(CompleteClip, DrivingKeysKeepEveryBit) {
  const Mixture m({host(), donor()}, kReplace);
  const Clip clip = m.complete(1, 2).clip;
  const Clip& source = m.inputs[1].clips[2];
  EXPECT_EQ(clip.duration, source.duration);
  for (const JointTracks& tracks : source.joints) {
    const JointId result = m.graft.sources[1].result_joint[tracks.joint.index()];
    if (!result.is_valid() || result == m.graft.sites[0].fused) continue;
    const JointTracks* copy = tracks_of(clip, result);
    ASSERT_NE(copy, nullptr);
    EXPECT_EQ(copy->rotation.times, tracks.rotation.times);
    for (std::size_t k = 0; k < tracks.rotation.values.size(); ++k)
      EXPECT_EQ(copy->rotation.values[k].coeffs(), tracks.rotation.values[k].coeffs());
  }
}

// By hand: a spline on the topmost joint; points take the whole change, tangents its linear part. P turns x
// to z and halves: (2,0,0) -> (0,0,1) + offset, tangent (4,0,0) -> (0,0,2).
TEST(CompleteClip, SplineOfTheTopmostJoint) {
  Character base, part;
  base.skeleton = straight_chain(2);
  part.skeleton = straight_chain(1);
  const Vec3 t(4, 0, 0), p(2, 0, 0);
  JointTracks tracks;
  tracks.joint = JointId(0);
  tracks.translation = {Interpolation::CubicSpline, {0, 1}, {t, p, t, t, p, t}};
  part.clips.push_back({"c", 1, {tracks}, {}});
  const Mixture m({base, part}, {{GraftKind::Attach, {"j0"}, 1, "j0", kPlacement}});
  const Clip clip = m.complete(1, 0).clip;
  ASSERT_EQ(clip.joints.size(), 1u);
  const auto& values = clip.joints[0].translation.values;
  EXPECT_THAT(values[0], IsNearVec(Vec3(0, 0, 2), 1e-12));
  EXPECT_THAT(values[1], IsNearVec(Vec3(1, 2, 4), 1e-12));
}

// Law (issue text): no synthesised joint turns faster than the fastest joint of the sources, and none of the
// parts stands still.
TEST(CompleteClip, BoundedAndMoving) {
  for (const auto& operations : {kReplace, kAttachTwo}) {
    const Mixture m({host(), donor()}, operations);
    for (std::size_t input = 0; input < 2; ++input)
      for (std::size_t c = 0; c < m.inputs[input].clips.size(); ++c) {
        const CompletedClip done = m.complete(input, c);
        EXPECT_LE(done.record.fastest_turn, done.record.fastest_source_turn * (1 + 1e-9));
        EXPECT_GT(done.record.fastest_turn, 0);
        std::vector<double> turned(m.graft.sources.size(), 0.0);
        for (const JointTracks& tracks : done.clip.joints)
          for (const Quat& q : tracks.rotation.values) {
            double& most = turned[m.graft.origins[tracks.joint.index()].source.index()];
            most = std::max(most, q.angularDistance(tracks.rotation.values.front()));
          }
        for (const double angle : turned) EXPECT_GT(angle, 0.05);  // radians; the calmest clip swings by 0.1
      }
  }
}

// Law: a loop stays a loop, key by key, and its speed across the end is no higher than within.
TEST(CompleteClip, LoopsStayLoops) {
  const Mixture m({host(), donor()}, kReplace);
  ASSERT_TRUE(m.motions[0].is_cyclic[0]);
  ASSERT_FALSE(m.motions[0].is_cyclic[1]);
  for (const auto& [input, c] : {std::pair<std::size_t, std::size_t>{0, 0}, {1, 0}, {1, 1}}) {
    const Clip clip = m.complete(input, c).clip;
    for (const JointTracks& tracks : clip.joints) {
      if (m.graft.sources[m.graft.origins[tracks.joint.index()].source.index()].input == input) continue;
      const auto& values = tracks.rotation.values;
      if (values.size() < 2) continue;
      EXPECT_NEAR(values.front().angularDistance(values.back()), 0, 1e-7);
      EXPECT_EQ(tracks.rotation.times.front(), 0);
      EXPECT_EQ(tracks.rotation.times.back(), clip.duration);
    }
  }
}

// Law: completing with oneself gives oneself. The same character twice; the copy's chosen keyframes are the
// clip's own.
TEST(CompleteClip, CompletingWithOneselfGivesOneself) {
  const Mixture m({host(), host()}, {{GraftKind::Replace, {"h4"}, 1, "h4", {}}});
  for (std::size_t c = 0; c < 2; ++c) {
    const CompletedClip done = m.complete(0, c);
    for (const auto& choice : done.record.choices) {
      EXPECT_EQ(choice.clip, m.inputs[1].clips[c].name);
      EXPECT_NEAR(choice.clip_time, choice.time, 1e-12);
    }
    EXPECT_NEAR(done.record.mean_distance, 0, 1e-5);  // floats
    for (std::size_t j = 0; j < m.inputs[1].skeleton.size(); ++j) {
      const JointId result = m.graft.sources[1].result_joint[j];
      if (!result.is_valid() || result == m.graft.sites[0].fused) continue;
      const JointTracks* tracks = tracks_of(done.clip, result);
      ASSERT_NE(tracks, nullptr);
      for (std::size_t k = 0; k < tracks->rotation.times.size(); ++k) {
        const Quat own = sample(m.inputs[1].clips[c].joints[j].rotation, tracks->rotation.times[k]);
        EXPECT_LT(own.angularDistance(tracks->rotation.values[k]), 1e-6);
      }
    }
  }
}

std::vector<std::pair<std::string, double>> choices_of(const CompletedClip& done) {
  std::vector<std::pair<std::string, double>> all;
  for (const auto& choice : done.record.choices) all.push_back({choice.clip, choice.clip_time});
  return all;
}

// Law: names, signs of quaternions, and turning a whole input (placed back by its placement) change no
// choice.
TEST(CompleteClip, ChoicesDoNotDependOnNamesSignsAndFrames) {
  const Mixture plain({host(), donor()}, kReplace);
  Character renamed = donor(), flipped = donor(), turned = donor();
  for (Joint& joint : renamed.skeleton.joints) joint.name += "_x";
  auto renamed_ops = kReplace;
  renamed_ops[0].joint += "_x";
  for (Clip& clip : flipped.clips)
    for (JointTracks& tracks : clip.joints)
      for (std::size_t k = 0; k < tracks.rotation.values.size(); k += 3)
        tracks.rotation.values[k].coeffs() *= -1;
  const Similarity turn{2, Quat(Eigen::AngleAxisd(1.1, Vec3(1, 2, 3).normalized())), Vec3(4, 5, 6)};
  Joint& root = turned.skeleton.joints[0];
  root.bind = premultiplied(turn, root.bind);
  for (Joint& joint : turned.skeleton.joints)
    joint.joint_from_model = joint.joint_from_model * turn.matrix().inverse();
  for (Clip& clip : turned.clips)
    for (Quat& q : clip.joints[0].rotation.values) q = turn.rotation * q;
  auto turned_ops = kReplace;
  const Affine3 back = kPlacement.matrix() * turn.matrix().inverse();
  turned_ops[0].model_from_input = {kPlacement.scale / turn.scale,
                                    kPlacement.rotation * turn.rotation.conjugate(), back.translation()};

  const Mixture other_names({host(), renamed}, renamed_ops), other_signs({host(), flipped}, kReplace),
      other_frame({host(), turned}, turned_ops);
  for (std::size_t input = 0; input < 2; ++input)
    for (std::size_t c = 0; c < 2; ++c) {
      const auto expected = choices_of(plain.complete(input, c));
      EXPECT_EQ(choices_of(other_names.complete(input, c)), expected);
      EXPECT_EQ(choices_of(other_signs.complete(input, c)), expected);
      EXPECT_EQ(choices_of(other_frame.complete(input, c)), expected);
    }
}

// Two parts of one input are one choice: a pair of wings beats together.
TEST(CompleteClip, PartsOfOneInputStayTogether) {
  const Mixture m({host(), donor()}, kAttachTwo);
  const auto choices = choices_of(m.complete(0, 0));
  ASSERT_EQ(choices.size() % 2, 0u);
  const std::size_t half = choices.size() / 2;
  for (std::size_t k = 0; k < half; ++k) EXPECT_EQ(choices[k], choices[k + half]);
}

TEST(CompleteClip, WithoutCompletionTheOthersStay) {
  CompletionOptions options;
  options.complete = false;
  const Mixture m({host(), donor()}, kReplace, options);
  const CompletedClip done = m.complete(0, 0);
  EXPECT_TRUE(done.record.choices.empty());
  for (const JointTracks& tracks : done.clip.joints)
    EXPECT_EQ(m.graft.origins[tracks.joint.index()].source, SourceId(0));
}

// The ugly: no clips to choose from, a clip of no length, a clip that moves nothing.
TEST(CompleteClip, PoorMaterial) {
  Character still = donor();
  still.clips.clear();
  const Mixture none({host(), still}, kReplace);
  EXPECT_TRUE(none.complete(0, 0).record.choices.empty());

  Character point = donor();
  point.clips = {{"Point", 0, {}, {}}};
  const Mixture m({host(), point}, kReplace);
  EXPECT_EQ(m.complete(1, 0).record.choices.size(), 1u);
  const CompletedClip frozen = m.complete(0, 0);  // nothing moves in the donor: its only pose is shown
  EXPECT_EQ(frozen.record.choices.size(), ClipFrames(1.0, 30).count - 1);
}

// A clip in which the part stands still is not chosen while others move it.
TEST(CompleteClip, StillClipsAreNotChosen) {
  Character part = donor();
  Clip still = part.clips[1];
  still.name = "Still";
  for (JointTracks& tracks : still.joints) {
    tracks.rotation.times.resize(1);
    tracks.rotation.values.resize(1);
  }
  part.clips.push_back(still);
  Character calm = host();
  calm.clips = {still};  // the driving clip does not move at all
  const Mixture m({calm, part}, kReplace);
  for (const auto& choice : m.complete(0, 0).record.choices) EXPECT_NE(choice.clip, "Still");
}

std::set<std::string> clips_of(const CompletedClip& done) {
  std::set<std::string> names;
  for (const auto& choice : done.record.choices) names.insert(choice.clip);
  return names;
}

// What the recipe may ask for one clip: clips to choose from, one clip to play, no loop.
TEST(CompleteClip, ChoosesAsAsked) {
  CompletionOptions use, with, once;
  use.clips = {{}, {{1, 2}, {}}};
  with.clips = {{}, {{}, 2}};
  once.loop = false;
  EXPECT_FALSE(clips_of(Mixture({host(), donor()}, kReplace, use).complete(0, 0)).contains("Run"));
  const CompletedClip played = Mixture({host(), donor()}, kReplace, with).complete(0, 0);
  EXPECT_EQ(clips_of(played), std::set<std::string>{"Hit"});
  for (std::size_t f = 1; f < 20; ++f)
    EXPECT_NEAR(played.record.choices[f].clip_time - played.record.choices[f - 1].clip_time, 1 / 30.0, 1e-9);
  EXPECT_TRUE(Mixture({host(), donor()}, kReplace).complete(0, 0).record.is_loop);
  EXPECT_FALSE(Mixture({host(), donor()}, kReplace, once).complete(0, 0).record.is_loop);
}

// A loop played in a loop goes round a whole number of times where its tempo allows: the walk of 1 s with the
// run of 0.7 s at 0.7 of its tempo. Any start is good that is nearest to the walk.
TEST(CompleteClip, PlaysALoopAWholeNumberOfTimes) {
  CompletionOptions options;
  options.clips = {{}, {{}, 0}};
  const CompletedClip done = Mixture({host(), donor()}, kReplace, options).complete(0, 0);
  EXPECT_EQ(done.record.jumps, 0);
  std::set<double> times;
  for (const auto& choice : done.record.choices) times.insert(choice.clip_time);
  EXPECT_EQ(times.size(), 21U);  // all frames of 0.7 s
}

// Law: in a loop the velocity of a completed joint changes no more across the end than it does inside the
// clip.
TEST(CompleteClip, LoopsCloseInVelocity) {
  const Mixture m({host(), donor()}, kReplace);
  for (const auto& [input, c] : {std::pair<std::size_t, std::size_t>{0, 0}, {1, 0}, {1, 1}}) {
    const Clip clip = m.complete(input, c).clip;
    for (const JointTracks& tracks : clip.joints) {
      if (m.graft.sources[m.graft.origins[tracks.joint.index()].source.index()].input == input) continue;
      const auto& values = tracks.rotation.values;
      const std::size_t n = values.size();
      if (n < 4) continue;
      const auto change_at = [&](std::size_t k) {  // of the velocity, at key k; the last key is the first
        const Quat in = values[(k + n - 2) % (n - 1)].conjugate() * values[k];
        return in.angularDistance(values[k].conjugate() * values[k + 1]);
      };
      double largest = 0;
      for (std::size_t k = 1; k + 1 < n; ++k) largest = std::max(largest, change_at(k));
      EXPECT_LE(change_at(0), 1.02 * largest + 1e-9);
    }
  }
}

// The paper's choice is nearer to the driving clip frame by frame, at the price of jumps.
TEST(CompleteClip, ThePapersChoiceJumps) {
  CompletionOptions paper;
  paper.choice = KeyframeChoice::Frame;
  const CompletedClip frames = Mixture({host(), donor()}, kReplace, paper).complete(0, 1),
                      sequence = Mixture({host(), donor()}, kReplace).complete(0, 1);
  EXPECT_GT(frames.record.jumps, 5 * sequence.record.jumps);
  EXPECT_LE(frames.record.mean_distance, sequence.record.mean_distance + 1e-6);
}

TEST(CompleteClip, HasKeysAtTheRateAsked) {
  CompletionOptions options;
  options.key_tolerance = 0;
  options.key_rate_hz = 24;
  const Mixture m({host(), donor()}, kReplace, options);
  const Clip clip = m.complete(0, 0).clip;
  for (const JointTracks& tracks : clip.joints)
    if (m.graft.origins[tracks.joint.index()].source == SourceId(1) && tracks.rotation.times.size() > 1) {
      EXPECT_EQ(tracks.rotation.times.size(), 25U);
    }
}

TEST(ClipFrames, EndsOnTheDuration) {
  const ClipFrames frames(0.52, 30);
  EXPECT_EQ(frames.count, 17u);
  EXPECT_EQ(frames.time(16), 0.52);
  EXPECT_NEAR(frames.time(1), 0.0325, 1e-12);
  EXPECT_EQ(ClipFrames(0, 30).count, 1u);
  EXPECT_EQ(ClipFrames(0.001, 30).count, 2u);
}

}  // namespace
}  // namespace skinforge
