#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "animation/completion.h"

namespace skinforge {

/// Distances in [0, 1] of #frames x #candidates, row after row.
struct DistanceTable {
  std::size_t frames = 0;
  std::size_t candidates = 0;
  std::vector<float> values;
  std::vector<float> frame_stance;  ///< #frames: distance of each from the usual stance (all joints at rest)
  std::vector<float> candidate_stance;  ///< #candidates, likewise

  std::span<const float> row(std::size_t frame) const {
    return {values.data() + frame * candidates, candidates};
  }
  std::span<float> row(std::size_t frame) { return {values.data() + frame * candidates, candidates}; }
};

/// Neighbours in time of each frame of a motion set. In a cyclic clip the last frame repeats the first, so
/// the one before it is followed by the first; the last itself is followed by the second. -1: none (ends of
/// other clips).
struct FrameSteps {
  std::vector<std::int32_t> next;
  std::vector<std::int32_t> previous;
};
FrameSteps frame_steps(const MotionSet& set);

/// Rotations of many frames at some joints, packed so that frames are compared with all of them at once.
class RotationTable {
 public:
  static constexpr std::size_t kAtOnce = 4;  ///< queries that cost as much as one

  /// `frames` x `weights.size()` x 4 numbers (x y z w) of unit quaternions. Weights need not sum to 1.
  RotationTable(std::span<const float> rotations, std::span<const float> weights);

  std::size_t frame_count() const { return frames_; }
  /// Adds to `sums` (#queries x `padded_count`, one per frame) the weighted |q . q'| with each of `queries`
  /// (#queries x #joints x 4).
  void add_similarities(std::span<const float> queries, std::span<float> sums) const;
  std::size_t padded_count() const;

 private:
  std::size_t frames_;
  std::vector<float> weights_;
  std::vector<float> packed_;  // per block of frames, per joint, per coefficient: the block's values
};

/// The driving motion of one source beside the candidates of another.
struct MotionPair {
  const MotionSet* driver;
  const MotionSet* candidate;
};

/// Keyframe distance of SkinMixer Sec. 8.1 between frames [first, first + count) of the drivers and all
/// frames of the candidates: 1 - the mean of |q . q'| over result joints. A joint weighs min(1, c) min(1, c')
/// with the summed confidences of both maps, so a joint that only one side reaches does not count (the paper
/// weighs by one sum). All pairs share their drivers' and their candidates' frames; their joints count
/// together. No joint in common: all 0. Cost: frames x candidates x joints.
DistanceTable keyframe_distances(std::span<const MotionPair> pairs, std::size_t first, std::size_t count);

/// One entry of that table: frame `frame` of the drivers (from their first) and candidate `candidate`.
double keyframe_distance(std::span<const MotionPair> pairs, std::size_t frame, std::size_t candidate);

/// Temporal continuity of Sec. 8.1: adds the distances one step before and after with weight 0.2, two steps
/// with 0.1, normalised to [0, 1]. `driver_steps` is relative to the table's rows; where a side has no such
/// step, its end holds. Works in the table it is given (10,000 x 10,000 entries are 400 MB).
DistanceTable windowed(DistanceTable table, const FrameSteps& driver_steps,
                       const FrameSteps& candidate_steps);

}  // namespace skinforge
