#pragma once

#include <span>

#include "report/report.h"

namespace skinforge {

/// The frame that a completed source shows at one time of a result clip.
struct ChosenFrame {
  std::int64_t source = 0;
  double time = 0;       ///< in the result clip, seconds
  std::string clip;      ///< it is taken from
  double clip_time = 0;  ///< seconds within it
};

/// The frames as runs: neighbours of one source and clip whose clip times keep one step (to half of it, so
/// resampled times stay together) become one. By source, then by time; frames of one source are given in
/// order of time. A run that stands still (step 0) is one run. No frames: no runs. O(n log n).
std::vector<FrameRun> frame_runs(std::span<const ChosenFrame> frames);

}  // namespace skinforge
