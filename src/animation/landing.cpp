#include "animation/landing.h"

#include <algorithm>

#include "animation/shift_scale.h"

namespace skinforge {
namespace {

constexpr double kTurning = 0.01;    // radians; ours: as much as a still clip may have
constexpr double kWandering = 0.01;  // ours: of the extent; less is a breathing joint, not a walk

std::vector<JointId> turning_joints(const MotionSet& set, std::span<const JointId> joints) {
  std::vector<JointId> turning;
  for (const JointId j : joints) {
    const auto turns = [&](const Pose& pose) {
      return pose[j.index()].rotation.angularDistance(set.poses.front()[j.index()].rotation) > kTurning;
    };
    if (std::any_of(set.poses.begin(), set.poses.end(), turns)) turning.push_back(j);
  }
  return turning;
}

std::vector<float> rotations_at(const MotionSet& set, std::span<const JointId> joints) {
  std::vector<float> rotations;
  rotations.reserve(set.poses.size() * joints.size() * 4);
  for (const Pose& pose : set.poses)
    for (const JointId j : joints)
      for (int k = 0; k < 4; ++k)
        rotations.push_back(static_cast<float>(pose[j.index()].rotation.coeffs()[k]));
  return rotations;
}

}  // namespace

LandingTable::LandingTable(const MotionSet& set, const Skeleton& skeleton, std::span<const JointId> joints)
    : frames_(set.poses.size()), table_({}, {}) {
  if (frames_ == 0) return;
  const std::vector<JointId> turning = turning_joints(set, joints);
  turning_ = turning.size();
  rotations_ = rotations_at(set, turning);
  table_ = RotationTable(
      rotations_,
      std::vector<float>(turning_, 1.0F / static_cast<float>(std::max<std::size_t>(1, turning_))));
  const std::vector<double> scales = shift_scales(skeleton);
  for (const JointId j : joints) {
    std::vector<Vec3> places;
    double farthest = 0;
    for (const Pose& pose : set.poses) {
      places.push_back(scales[j.index()] * pose[j.index()].translation);
      farthest = std::max(farthest, (places.back() - places.front()).norm());
    }
    if (farthest > kWandering) shifts_.push_back(std::move(places));
  }
}

std::span<const float> LandingTable::row(std::int32_t frame) {
  std::vector<float>& row = rows_[frame];
  if (!row.empty()) return row;
  const auto f = static_cast<std::size_t>(frame);
  row.assign(turning_ > 0 ? table_.padded_count() : frames_, 0.0F);
  if (turning_ > 0)
    table_.add_similarities(std::span(rotations_).subspan(f * turning_ * 4, turning_ * 4), row);
  row.resize(frames_);
  for (std::size_t c = 0; c < frames_; ++c) {
    double shift = 0;
    for (const auto& places : shifts_) shift = std::max(shift, (places[c] - places[f]).norm());
    row[c] = (turning_ > 0 ? std::max(0.0F, 1 - row[c]) : 0.0F) + static_cast<float>(shift);
  }
  return row;
}

}  // namespace skinforge
