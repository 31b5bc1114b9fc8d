#pragma once

#include <span>
#include <string>
#include <vector>

#include "animation/completion.h"

namespace skinforge {

/// Sources of one input that a clip of another input does not drive: they are completed together, by one
/// sequence of keyframes, so that a pair of wings stays a pair.
struct PartToComplete {
  std::size_t input = 0;
  std::vector<SourceId> sources;
};

/// What drives: a clip of `input`, which comes to the result in one or more sources.
struct DrivingClip {
  std::size_t input = 0;
  std::size_t clip = 0;
  std::vector<SourceId> sources;
};

/// Tracks of a completed part for the result skeleton, and what was chosen.
struct CompletedPart {
  std::vector<JointTracks> joints;  ///< only joints that leave the bind pose, sorted within each source
  std::vector<CompletionRecord::Choice> choices;
  double mean_distance = 0;
};

/// The parts that `driver` leaves to be completed, in order of their first source.
std::vector<PartToComplete> parts_to_complete(const Graft& graft, std::size_t driving_input);

/// Chooses keyframes for `part` and turns them into tracks (completion.md, steps 3 to 6). A part whose input
/// has no clip stays in its bind pose. Arguments as for `complete_clip`.
CompletedPart complete_part(std::span<const Character* const> characters, const Graft& graft,
                            std::span<const MotionSet* const> motions, const DrivingClip& driver,
                            const PartToComplete& part, const CompletionOptions& options);

}  // namespace skinforge
