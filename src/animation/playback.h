#pragma once

#include <span>
#include <vector>

#include "animation/keyframe_path.h"

namespace skinforge {

/// A place in a clip of a motion set, in frames from its first one; wraps in a cyclic clip, holds at the ends
/// of others.
struct ClipPosition {
  std::size_t clip = 0;
  double frame = 0;
};

/// What a completed part shows in one frame: a place in a clip, or two of them blended (0 = `from`, 1 =
/// `to`).
struct PlaybackFrame {
  ClipPosition from;
  ClipPosition to;
  double blend = 0;
};

/// Turns a path into something to play: between jumps the tempo is evened out (holds and skips become a
/// steady speed), and each jump becomes a crossfade of up to `half_fade` frames to either side, during which
/// both stretches go on. `is_loop`: all of this also across the end. One entry per frame of the path.
std::vector<PlaybackFrame> play(const KeyframePath& path, const MotionSet& set, bool is_loop,
                                std::size_t half_fade);

/// Between two transforms, 0 = a, 1 = b: translation and scale in a line, rotation by the shortest turn.
Transform blend(const Transform& a, const Transform& b, double share);

/// Turns the rotations of one joint until no two neighbours (in a loop also the last and the first) are more
/// than `limit` radians apart, by moving offending neighbours towards each other, over and over. Limit 0
/// leaves them all as the first.
void limit_turns(std::vector<Quat>& rotations, double limit, bool is_loop);

}  // namespace skinforge
