// Joint maps and completed clips on the characters of data/: what the hand-made skeletons of tests/skeleton
// and tests/animation cannot show.
#include <gmock/gmock.h>

#include <cmath>
#include <set>

#include "animation/completion.h"
#include "animation/sampling.h"
#include "base/issue.h"
#include "io/import.h"
#include "testing/assets.h"

namespace skinforge {
namespace {
using testing::repository_file;

// Two characters of data/ with one operation, and all that completion needs.
struct Mixed {
  std::vector<Character> inputs;
  std::vector<const Character*> characters;
  std::vector<const Skeleton*> skeletons;
  Graft graft;
  std::vector<JointMap> maps;
  std::vector<MotionSet> motions;
  CompletionOptions options;

  Mixed(const std::string& base, const std::string& part, GraftOperation operation) {
    IssueSink issues;
    const std::vector<std::string> names = {base, part};
    for (const std::string& name : names)
      inputs.push_back(import_character(repository_file("data/" + name + ".glb"), issues));
    for (const Character& c : inputs) {
      characters.push_back(&c);
      skeletons.push_back(&c.skeleton);
    }
    operation.input = 1;
    graft = graft_skeletons(skeletons, names, 0, std::vector{operation}, issues);
    maps = build_joint_maps(skeletons, graft);
    for (std::size_t k = 0; k < graft.sources.size(); ++k)
      motions.push_back(build_motion_set(inputs[graft.sources[k].input], graft, SourceId(k), maps[k]));
  }
  Mixed(const Mixed&) = delete;

  CompletedClip complete(std::size_t input, std::size_t clip) const {
    std::vector<const MotionSet*> sets;
    for (const MotionSet& set : motions) sets.push_back(&set);
    return complete_clip(characters, graft, sets, input, clip, inputs[input].clips[clip].name, options);
  }
  CompletedClip complete(std::size_t input, const std::string& clip) const {
    for (std::size_t c = 0; c < inputs[input].clips.size(); ++c)
      if (inputs[input].clips[c].name == clip) return complete(input, c);
    throw std::invalid_argument("no clip " + clip);
  }
  // Skinned points of the driving part in the result and in its placed source, relative to the graft's own
  // parent.
  bool is_driven(const JointTracks& tracks, std::size_t input) const {
    return graft.sources[graft.origins[tracks.joint.index()].source.index()].input == input;
  }
};

GraftOperation replace(const std::string& at, const std::string& joint) {
  return {GraftKind::Replace, {at}, 1, joint, {1.2, Quat::Identity(), Vec3(0, 0.355, 0.683)}};
}

struct Case {
  const char *base, *part, *at, *joint;
};
const Case kCases[] = {{"horse", "human", "Neck1", "Spine"},
                       {"human", "dolphin", "UpperLeg.L", "Tail1"},
                       {"horse", "griffin", "Neck1", "Neck"},
                       {"human", "human", "Neck", "Neck"}};

// Issue text, 7.3: every clip has its duration, the other part moves, nothing turns faster than in the
// sources.
TEST(MotionOnCharacters, BoundedMovingAndClosed) {
  for (const Case& each : kCases) {
    const Mixed m(each.base, each.part, replace(each.at, each.joint));
    for (std::size_t input = 0; input < 2; ++input)
      for (std::size_t c = 0; c < m.inputs[input].clips.size(); ++c) {
        SCOPED_TRACE(std::string(each.base) + "+" + each.part + " " + m.inputs[input].clips[c].name);
        const CompletedClip done = m.complete(input, c);
        EXPECT_EQ(done.clip.duration, m.inputs[input].clips[c].duration);
        EXPECT_LE(done.record.fastest_turn, done.record.fastest_source_turn * (1 + 1e-9));
        const bool is_loop = m.motions[input].is_cyclic[c];
        double farthest = 0;
        for (const JointTracks& tracks : done.clip.joints) {
          if (m.is_driven(tracks, input) || tracks.rotation.is_empty()) continue;
          const auto& values = tracks.rotation.values;
          for (const Quat& q : values) farthest = std::max(farthest, q.angularDistance(values.front()));
          if (is_loop) {
            EXPECT_LT(values.front().angularDistance(values.back()), 1e-7);
          }
        }
        EXPECT_GT(farthest, 0.01);  // radians: what a still clip may have at most
      }
  }
}

// Law: a head swap between equal rigs maps every joint to the one of its name.
TEST(MotionOnCharacters, EqualRigsMapByName) {
  const Mixed m("human", "human", replace("Neck", "Neck"));
  for (std::size_t k = 0; k < 2; ++k)
    for (std::size_t j = 0; j < m.maps[k].size(); ++j) {
      const JointOrigin& origin = m.graft.origins[m.maps[k][j].image.index()];
      EXPECT_EQ(m.skeletons[1]->joints[origin.joint.index()].name, m.skeletons[k]->joints[j].name);
    }
}

// What an animator would take: the calm for the calm, the walk for the walk, the lively for the lively.
TEST(MotionOnCharacters, CentaurMovesAsOne) {
  const Mixed m("horse", "human", replace("Neck1", "Spine"));
  const auto clips_of = [](const CompletedClip& done) {
    std::set<std::string> names;
    for (const auto& choice : done.record.choices) names.insert(choice.clip);
    return names;
  };
  EXPECT_EQ(clips_of(m.complete(0, "Idle")), std::set<std::string>{"Idle"});
  EXPECT_EQ(clips_of(m.complete(1, "Idle")), std::set<std::string>{"Idle"});
  EXPECT_EQ(clips_of(m.complete(0, "Walk")), std::set<std::string>{"Walk"});
  EXPECT_EQ(clips_of(m.complete(1, "Walk")), std::set<std::string>{"Walk"});
  EXPECT_FALSE(clips_of(m.complete(0, "Gallop")).contains("Idle"));
}

}  // namespace
}  // namespace skinforge
