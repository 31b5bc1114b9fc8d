#pragma once

#include <map>
#include <span>
#include <vector>

#include "animation/keyframe_distance.h"

namespace skinforge {

/// How unlike two keyframes leave a completed part: the mean of 1 - |q . q'| over its joints' local
/// rotations, plus the largest-moving joints' translations as shares of the skeleton's extent. Joints that
/// never move are left out.
class LandingTable {
 public:
  /// `joints`: of the input, those that come to the result. `skeleton`: of the input.
  LandingTable(const MotionSet& set, const Skeleton& skeleton, std::span<const JointId> joints);

  /// From keyframe `frame` to every keyframe. Rows are worked out when first asked for.
  std::span<const float> row(std::int32_t frame);

 private:
  std::size_t frames_;
  std::vector<float> rotations_;  // #frames x #turning joints x 4
  std::size_t turning_ = 0;
  RotationTable table_;
  std::vector<std::vector<Vec3>> shifts_;  // per wandering joint, per frame: place in shares of the extent
  std::map<std::int32_t, std::vector<float>> rows_;
};

}  // namespace skinforge
