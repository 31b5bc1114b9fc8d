#pragma once

#include <span>
#include <vector>

#include "animation/clip_player.h"
#include "animation/completion.h"
#include "animation/limb_clearing.h"
#include "animation/resampling.h"

namespace skinforge {

/// What a completed part plays, and when: everything that its tracks are made from.
struct PartMotion {
  ClipPlayer* player = nullptr;
  std::vector<PlaybackFrame> playback;  ///< one per search frame; in a loop without the repeated last
  bool is_loop = false;
  double delay = 0;             ///< search frames that the part is behind (limbs.h)
  ClipFrames search;            ///< grid of `playback`
  ClipFrames keys;              ///< grid of the tracks
  double fastest_turn = 0;      ///< that a rotation may have, rad/s
  std::vector<LimbTurn> turns;  ///< of the part's joints, for the whole clip
  bool is_smoothed = false;     ///< by (1 2 1) / 4, the paper's light smoothing, in place of the speed bound
};

/// Tracks for the joints that `source` brings to the result; only those that leave the bind pose. No rotation
/// turns faster than the fastest of the part's input.
std::vector<JointTracks> part_tracks(const Graft& graft, SourceId source, const PartMotion& motion);

}  // namespace skinforge
