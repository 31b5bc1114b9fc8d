#pragma once

#include <span>
#include <vector>

#include "animation/keyframe_distance.h"

namespace skinforge {

/// One per joint of the set's input.
std::vector<JointRange> joint_ranges(std::span<const Pose> poses, const Skeleton& skeleton);

/// What jumps between keyframes cost a completed part. Two poses differ by the mean of 1 - |q . q'| over the
/// local rotations of its 16 most-turning joints, plus the largest difference of their translations as a
/// share of the skeleton's extent. A jump from s to t costs twice the mean of (next of s, t) and (s, previous
/// of t), so velocities count too.
class LandingTable {
 public:
  /// `joints`: of the input, those that come to the result. `skeleton`: of the input. `steps`: of `set`;
  /// kept.
  LandingTable(const MotionSet& set, const Skeleton& skeleton, std::span<const JointId> joints,
               const FrameSteps& steps);

  /// From keyframe `from` to every keyframe; valid until the next call. Rows are worked out when first asked
  /// for, and stay as long as there is room.
  std::span<const float> row(std::int32_t from);

 private:
  const Eigen::ArrayXf& pose_distances(std::size_t frame);
  void compare_poses(std::size_t first, std::size_t count);
  void add_shift(std::size_t frame);
  void make_room();

  const FrameSteps& steps_;
  std::size_t frames_;
  std::vector<float> rotations_;  // #frames x #turning joints x 4
  std::size_t turning_ = 0;
  RotationTable table_;
  std::vector<std::size_t> first_frames_;  // frames whose predecessor is not the one before them in the set
  std::vector<Eigen::ArrayX3f> shifts_;    // per wandering joint, #frames: place in shares of the extent
  std::vector<Eigen::ArrayXf> distances_;  // per frame, to all others, once worked out
  std::vector<Eigen::ArrayXf> rows_;       // per frame, once asked for
  std::size_t kept_ = 0;                   // of both
};

}  // namespace skinforge
