#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/issue.h"
#include "model/character.h"
#include "skeleton/graft.h"
#include "skeleton/joint_map.h"
#include "skeleton/pose.h"

namespace skinforge {

/// How keyframes are chosen for the completed parts.
enum class KeyframeChoice : std::uint8_t {
  Sequence,  ///< the best whole sequence, by dynamic programming
  Frame,     ///< the paper's: the best keyframe for each frame on its own
};

struct CompletionOptions {
  double rate_hz = 30;   ///< resampling for the comparison (Sec. 8.1)
  bool complete = true;  ///< false: the other parts stay in their bind pose
  KeyframeChoice choice = KeyframeChoice::Sequence;

  template <class Archive>
  friend void fields(Archive& a, CompletionOptions& o) {
    a(o.rate_hz, o.complete, o.choice);
  }
};

/// All clips of one source, resampled and mapped onto the result skeleton: the candidates k'' of Sec. 8.1.
struct MotionSet {
  std::vector<std::int32_t> clip_begin = {0};  ///< #clips + 1 offsets into the frames
  std::vector<double> frame_time;              ///< #frames, seconds within the clip
  std::vector<Pose> poses;                     ///< #frames, local transforms of the input's joints
  std::vector<float> rotations;    ///< #frames x #result joints x 4, global rotations of B(k''), x y z w
  std::vector<double> confidence;  ///< #result joints, summed over the map (Sec. 8.1)
  std::vector<float>
      activity;  ///< #frames, mean joint speed over half a second; 1 = the liveliest clip's mean
  std::vector<bool> is_cyclic;  ///< #clips: the last pose nearly meets the first; `poses` then close exactly
  std::vector<bool> is_moving;  ///< #clips: the joints that this source brings to the result move
  double fastest_turn = 0;      ///< of any joint of the input between frames, local, rad/s

  template <class Archive>
  friend void fields(Archive& a, MotionSet& m) {
    a(m.clip_begin, m.frame_time, m.poses, m.rotations, m.confidence, m.activity, m.is_cyclic, m.is_moving,
      m.fastest_turn);
  }
};

/// What the completion of one clip chose and measured, for the report.
struct CompletionRecord {
  std::string clip;         ///< name in the result
  std::size_t input = 0;    ///< input that drives it
  std::string source_clip;  ///< its name there
  double duration = 0;      ///< seconds
  struct Choice {
    SourceId source;       ///< the completed part
    double time = 0;       ///< in the result clip, seconds
    std::string clip;      ///< candidate taken from
    double clip_time = 0;  ///< seconds within it
    template <class Archive>
    friend void fields(Archive& a, Choice& c) {
      a(c.source, c.time, c.clip, c.clip_time);
    }
  };
  std::vector<Choice> choices;     ///< per completed source, one per resampled frame
  double mean_distance = 0;        ///< mean keyframe distance of the choices, 0 = alike
  double fastest_turn = 0;         ///< of any joint in the result clip, rad/s
  double fastest_source_turn = 0;  ///< of any joint in any clip of the inputs, rad/s
  std::string fastest_joint;

  template <class Archive>
  friend void fields(Archive& a, CompletionRecord& r) {
    a(r.clip, r.input, r.source_clip, r.duration, r.choices, r.mean_distance, r.fastest_turn,
      r.fastest_source_turn, r.fastest_joint);
  }
};

struct CompletedClip {
  Clip clip;  ///< for the result skeleton
  CompletionRecord record;

  template <class Archive>
  friend void fields(Archive& a, CompletedClip& c) {
    a(c.clip, c.record);
  }
};

/// Resamples all clips of `source`'s input and maps them through its joint map (Sec. 8.1: several joints on
/// one image cumulate their rotations, images that no joint reaches get the identity).
MotionSet build_motion_set(const Character& input, const Graft& graft, SourceId source, const JointMap& map,
                           const CompletionOptions& options);

/// Completes clip `clip` of input `input` (Sec. 8): all sources of that input keep their own tracks bit for
/// bit (the top joint of a grafted sub-tree by the formula of completion.md), every other source is driven by
/// its best keyframes. `characters`: one per input; `motions`: one per source. `name`: the clip's name in the
/// result.
CompletedClip complete_clip(std::span<const Character* const> characters, const Graft& graft,
                            std::span<const MotionSet* const> motions, std::size_t input, std::size_t clip,
                            const std::string& name, const CompletionOptions& options);

}  // namespace skinforge
