#pragma once

#include <array>
#include <optional>
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

constexpr double kSearchRate = 30;  ///< frames a second that are compared (Sec. 8.1)

/// What the clips of one input may be used for in one completion.
struct ClipChoice {
  std::vector<std::size_t> use;     ///< clips that keyframes may come from; empty: all
  std::optional<std::size_t> with;  ///< clip that is played as it is, without a search

  template <class Archive>
  friend void fields(Archive& a, ClipChoice& c) {
    a(c.use, c.with);
  }
};

/// How one clip is completed.
struct CompletionOptions {
  bool complete = true;  ///< false: the other parts stay in their bind pose
  KeyframeChoice choice = KeyframeChoice::Sequence;
  std::optional<double> key_rate_hz;  ///< of completed tracks; by default the clip's own, or `kSearchRate`
  std::array<double, 2> tempo = {0.5, 2};  ///< of the part's clips, slowest in [0.5, 1] and fastest in [1, 2]
  std::optional<bool> loop;                ///< whether the clip is a loop; by default as its poses say
  /// Share of a step by which limbs that the body has twice follow each other, 0 = alike; by default 1 / (how
  /// many there are of a kind).
  std::optional<double> limb_phase;
  double clearing = radians(40);  ///< that limbs of a completed part may be turned out of the driving part
  double key_tolerance = 1e-4;    ///< what leaving out keys may move, of the base's diagonal
  std::vector<ClipChoice> clips;  ///< per input; empty: anything goes

  template <class Archive>
  friend void fields(Archive& a, CompletionOptions& o) {
    a(o.complete, o.choice, o.key_rate_hz, o.tempo, o.loop, o.limb_phase, o.clearing, o.key_tolerance,
      o.clips);
  }
};

/// What a foot does in the clips of its own input: a joint whose skin is near the ground in the bind pose.
struct Foot {
  JointId joint;       ///< of the input
  double lowest = 0;   ///< height of its joint over all clips, at least, metres in the input
  double ground = 0;   ///< height below which it stands, metres in the input
  double fastest = 0;  ///< speed along the ground while it stands, over all clips, at most, m/s in the input

  template <class Archive>
  friend void fields(Archive& a, Foot& f) {
    a(f.joint, f.lowest, f.ground, f.fastest);
  }
};

/// A ball inside the skin of a joint, for asking roughly whether parts cut each other.
struct SkinBall {
  JointId joint;               ///< of the input
  Vec3 center = Vec3::Zero();  ///< in the joint's frame
  double radius = 0;           ///< metres in the input

  template <class Archive>
  friend void fields(Archive& a, SkinBall& b) {
    a(b.joint, b.center, b.radius);
  }
};

/// Where the balls of a source are at a site where it meets another source.
struct SeamBalls {
  std::size_t site = 0;       ///< of the graft
  std::vector<Vec3> bind;     ///< #balls, in the bind pose, in the frame of the joint where the sources meet
  std::vector<float> places;  ///< #balls x 3 x #frames, in the same frame

  template <class Archive>
  friend void fields(Archive& a, SeamBalls& b) {
    a(b.site, b.bind, b.places);
  }
};

/// How far a joint moves, within its parent, away from where it is in the first frame of a motion set.
struct JointRange {
  double turn = 1;   ///< least |q . q'| of its rotations
  double shift = 0;  ///< farthest translation, as a share of the skeleton's extent

  template <class Archive>
  friend void fields(Archive& a, JointRange& r) {
    a(r.turn, r.shift);
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
  double fastest_turn = 0;      ///< of any joint of the input between frames or keys, local, rad/s
  std::vector<double>
      skin_radius;  ///< #input joints, metres in the input: within it lies the joint's skin, or
                    ///< what may hang on a joint without skin (a twentieth of the diagonal)
  std::vector<JointRange> ranges;  ///< #input joints
  std::vector<Foot> feet;          ///< of the input
  std::vector<SkinBall> balls;     ///< in the skin of the joints that this source brings to the result
  std::vector<SeamBalls> seams;    ///< one per site where this source meets another

  template <class Archive>
  friend void fields(Archive& a, MotionSet& m) {
    a(m.clip_begin, m.frame_time, m.poses, m.rotations, m.confidence, m.activity, m.is_cyclic, m.is_moving,
      m.fastest_turn, m.skin_radius, m.ranges, m.feet, m.balls, m.seams);
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
  struct Turn {
    std::string joint;  ///< of the result
    double angle = 0;   ///< radians
    template <class Archive>
    friend void fields(Archive& a, Turn& t) {
      a(t.joint, t.angle);
    }
  };
  std::vector<Turn> turns;      ///< of limbs, for the whole clip, so that they don't cut the driving part
  std::vector<Choice> choices;  ///< per completed source, one per resampled frame
  double mean_distance = 0;     ///< mean keyframe distance of the choices, 0 = alike
  std::int64_t cutting_frames =
      0;                    ///< in which parts were about to cut each other, so that others were sought
  std::int64_t jumps = 0;   ///< between the choices of all parts: steps that no clip makes
  bool is_loop = false;     ///< completed as one
  double fastest_turn = 0;  ///< of any joint in the result clip, rad/s
  double fastest_source_turn = 0;  ///< of any joint in any clip of the inputs, rad/s
  std::string fastest_joint;

  template <class Archive>
  friend void fields(Archive& a, CompletionRecord& r) {
    a(r.clip, r.input, r.source_clip, r.duration, r.turns, r.choices, r.mean_distance, r.cutting_frames,
      r.jumps, r.is_loop, r.fastest_turn, r.fastest_source_turn, r.fastest_joint);
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
MotionSet build_motion_set(const Character& input, const Graft& graft, SourceId source, const JointMap& map);

/// Completes clip `clip` of input `input` (Sec. 8): all sources of that input keep their own tracks bit for
/// bit (the top joint of a grafted sub-tree by the formula of completion.md), every other source is driven by
/// its best keyframes. `characters`: one per input; `motions`: one per source. `name`: the clip's name in the
/// result.
CompletedClip complete_clip(std::span<const Character* const> characters, const Graft& graft,
                            std::span<const MotionSet* const> motions, std::size_t input, std::size_t clip,
                            const std::string& name, const CompletionOptions& options);

}  // namespace skinforge
