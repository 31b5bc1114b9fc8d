#pragma once

#include <span>

#include "animation/completed_part.h"
#include "animation/keyframe_path.h"

namespace skinforge {

/// Frames of the driving clip on the grid of the motion sets.
struct DriverFrames {
  ClipFrames grid;
  std::size_t first;  ///< in the motion set
  std::size_t rows;   ///< frames to choose for: in a loop the last one repeats the first
  bool is_loop;
};

DriverFrames driver_frames(const Character& character, const MotionSet& set, const DrivingClip& driver,
                           const CompletionOptions& options);

/// The keyframes that `part` shows in each row, and how far they are from the driving frames.
struct ChosenKeyframes {
  KeyframePath path;
  double mean_distance = 0;         ///< 0 = alike
  std::int64_t cutting_frames = 0;  ///< rows in which the parts were about to cut each other
};

/// Chooses (completion.md, steps 3 to 6): the driving clip itself for more limbs of its own input; the clip
/// that the options want (`with`) from its best place on; otherwise the best sequence, or the paper's choice.
/// Arguments as for `complete_clip`; the part's motion set must have frames.
ChosenKeyframes choose_keyframes(std::span<const Character* const> characters, const Graft& graft,
                                 std::span<const MotionSet* const> motions, const DrivingClip& driver,
                                 const PartToComplete& part, const DriverFrames& frames,
                                 const CompletionOptions& options);

}  // namespace skinforge
