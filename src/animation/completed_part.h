#pragma once

#include <span>
#include <string>
#include <vector>

#include "animation/completion.h"
#include "animation/limbs.h"
#include "animation/resampling.h"

namespace skinforge {

/// Sources of one input that are completed together, by one sequence of keyframes, so that a pair of wings
/// stays a pair.
struct PartToComplete {
  std::size_t input = 0;
  LimbRank rank;
  double steps_behind = 0;  ///< the driving clip
  std::vector<SourceId> sources;
};

/// What drives: a clip of `input`, which comes to the result in one or more sources.
struct DrivingClip {
  std::size_t input = 0;
  std::size_t clip = 0;
  std::vector<SourceId> sources;  ///< those that keep its keys
};

/// The driving clip, and the parts that it leaves to be completed, in order of their first source: sources of
/// other inputs, and further limbs of the same input unless they are to move alike or nothing is completed.
struct Casting {
  DrivingClip driver;
  std::vector<PartToComplete> parts;
};
Casting cast_sources(std::span<const Character* const> characters, const Graft& graft, std::size_t input,
                     std::size_t clip, const CompletionOptions& options);

/// Tracks of a completed part for the result skeleton, and what was chosen.
struct CompletedPart {
  std::vector<JointTracks> joints;  ///< only joints that leave the bind pose, sorted within each source
  std::vector<CompletionRecord::Choice> choices;
  double mean_distance = 0;
  std::int64_t cutting_frames = 0;
  std::int64_t jumps = 0;
  std::vector<CompletionRecord::Turn> turns;
};

/// Chooses keyframes for `part` and turns them into tracks with keys on `keys` (completion.md, steps 3 to 8).
/// A part whose input has no clip stays in its bind pose. Arguments as for `complete_clip`.
CompletedPart complete_part(std::span<const Character* const> characters, const Graft& graft,
                            std::span<const MotionSet* const> motions, const DrivingClip& driver,
                            const PartToComplete& part, const ClipFrames& keys,
                            const CompletionOptions& options);

}  // namespace skinforge
