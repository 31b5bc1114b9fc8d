#pragma once

#include <optional>
#include <vector>

#include "animation/completion.h"
#include "animation/playback.h"

namespace skinforge {

/// Plays the clips of one input: at the frames of a motion set as they are there, anywhere between them as
/// the clips themselves are interpolated, with loops closed as in the set.
class ClipPlayer {
 public:
  /// Both must outlive it.
  ClipPlayer(const Character& input, const MotionSet& set);

  /// Local transform of input joint `joint`.
  Transform at(const ClipPosition& position, JointId joint);
  Transform at(const PlaybackFrame& frame, JointId joint);
  /// Between two frames that follow each other: on in the same clips where they play on, else blended.
  Transform between(const PlaybackFrame& before, const PlaybackFrame& after, double share, JointId joint);

 private:
  struct Keyed {
    std::vector<const JointTracks*> tracks;  // per joint, or none
    Pose first, last;                        // as the clip has them, of a loop
  };
  const Keyed& keyed(std::size_t clip);
  Transform from_keys(std::size_t clip, double place, JointId joint);
  std::size_t last_frame(std::size_t clip) const;
  std::optional<ClipPosition> between(const ClipPosition& before, const ClipPosition& after,
                                      double share) const;

  const Character& input_;
  const MotionSet& set_;
  std::vector<std::optional<Keyed>> keyed_;  // per clip, when asked for
};

}  // namespace skinforge
