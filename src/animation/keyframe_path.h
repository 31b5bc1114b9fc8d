#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "animation/keyframe_distance.h"

namespace skinforge {

/// How a path came to a keyframe from the one before.
enum class PathStep : std::uint8_t {
  Next,  ///< the natural successor
  Hold,  ///< the same again (half speed); never twice in a row but at the end of a clip
  Skip,  ///< the successor's successor (double speed)
  Jump,  ///< any other
};

/// The chosen keyframes: one per frame of the driving clip.
struct KeyframePath {
  std::vector<std::int32_t> candidates;
  std::vector<PathStep> steps;  ///< how each was reached; the first one from the last in a loop, else Next
};

/// What moving along a path costs, in units of the keyframe distance, and how often the tempo may change.
struct PathCosts {
  static constexpr int kNever = 255;
  int hold_wait = 1;    ///< frames between two holds at least; 1: down to half speed; kNever: no holds
  int skip_wait = 0;    ///< frames between two skips at least; 0: up to double speed; kNever: no skips
  float tempo = 0.03F;  ///< a Hold or Skip; ours, see completion.md
  float jump = 0.8F;    ///< a Jump; ours, see completion.md
};

/// What landing on each keyframe costs a jump that leaves from `from`: 0 = nobody will notice. The span is
/// valid until the next call.
using LandingCosts = std::function<std::span<const float>(std::int32_t from)>;

/// The sequence of keyframes with the lowest sum of distances and step costs, by dynamic programming over
/// (frame, keyframe). A clip that ends may be held on its last keyframe for as long as it likes, once a third
/// of a second of it has been played (someone who lies down stays there), but not in a loop. `allowed`: per
/// candidate; at least one. `is_loop`: frame 0 follows the last frame; the path is closed by two laps of free
/// search, then one lap back to the keyframe found in the middle. Jumps leave only from the 12 cheapest
/// keyframes of a frame. Cost: frames x candidates x 12 at worst; memory: a byte each.
KeyframePath best_path(const DistanceTable& distances, const FrameSteps& steps,
                       const std::vector<bool>& allowed, const LandingCosts& landing, bool is_loop,
                       const PathCosts& costs = {});

/// The best keyframe for each frame on its own (the paper's choice).
KeyframePath best_frames(const DistanceTable& distances, const FrameSteps& steps,
                         const std::vector<bool>& allowed);

}  // namespace skinforge
