#pragma once

#include <string>
#include <vector>

#include "animation/completion.h"
#include "base/issue.h"
#include "skeleton/skeletons.h"

/// Characters without a mesh, with clips made by formula, for the tests of this layer.
namespace skinforge::testing {

struct SwingSpec {
  std::string name;
  double duration = 1;     ///< seconds
  double amplitude = 0.5;  ///< radians
  double cycles = 1;       ///< per clip; a whole number makes a loop
  unsigned seed = 0;
};

/// Every joint swings about an axis of its own by amplitude * sin(2 pi cycles t / duration + phase); 24 keys
/// a second.
inline Clip swing_clip(const Skeleton& skeleton, const SwingSpec& spec) {
  std::mt19937 random(spec.seed);
  Clip clip{spec.name, spec.duration, {}, {}};
  const int keys = std::max(2, static_cast<int>(spec.duration * 24) + 1);
  for (std::size_t j = 0; j < skeleton.size(); ++j) {
    const Vec3 axis = random_vector(random).normalized();
    const double phase = std::uniform_real_distribution<double>(0, 6.28)(random);
    JointTracks tracks;
    tracks.joint = JointId(j);
    for (int k = 0; k < keys; ++k) {
      const double share = static_cast<double>(k) / (keys - 1);
      const double angle = spec.amplitude * std::sin(2 * std::numbers::pi * spec.cycles * share + phase);
      tracks.rotation.times.push_back(k + 1 == keys ? spec.duration : spec.duration * share);
      tracks.rotation.values.push_back(skeleton.joints[j].bind.rotation *
                                       Quat(Eigen::AngleAxisd(angle, axis)));
    }
    clip.joints.push_back(std::move(tracks));
  }
  return clip;
}

inline Character swinging_character(const Skeleton& skeleton, const std::vector<SwingSpec>& clips) {
  Character c;
  c.name = "swinging";
  c.skeleton = skeleton;
  for (const SwingSpec& spec : clips) c.clips.push_back(swing_clip(skeleton, spec));
  return c;
}

/// Inputs, what was done to them, and all that completion needs.
struct Mixture {
  std::vector<Character> inputs;
  std::vector<const Character*> pointers;
  Graft graft;
  std::vector<JointMap> maps;
  std::vector<MotionSet> motions;
  CompletionOptions options;

  Mixture(std::vector<Character> characters, const std::vector<GraftOperation>& operations,
          CompletionOptions how = {})
      : inputs(std::move(characters)), options(how) {
    IssueSink issues;
    std::vector<const Skeleton*> skeletons;
    std::vector<std::string> names;
    for (const Character& c : inputs) {
      pointers.push_back(&c);
      skeletons.push_back(&c.skeleton);
      names.push_back("input" + std::to_string(names.size()));
    }
    graft = graft_skeletons(skeletons, names, 0, operations, issues);
    maps = build_joint_maps(skeletons, graft);
    for (std::size_t k = 0; k < graft.sources.size(); ++k)
      motions.push_back(
          build_motion_set(inputs[graft.sources[k].input], graft, SourceId(k), maps[k]));
  }
  Mixture(const Mixture&) = delete;

  CompletedClip complete(std::size_t input, std::size_t clip) const {
    std::vector<const MotionSet*> sets;
    for (const MotionSet& set : motions) sets.push_back(&set);
    return complete_clip(pointers, graft, sets, input, clip, inputs[input].clips[clip].name, options);
  }
};

inline const JointTracks* tracks_of(const Clip& clip, JointId joint) {
  for (const JointTracks& tracks : clip.joints)
    if (tracks.joint == joint) return &tracks;
  return nullptr;
}

}  // namespace skinforge::testing
