#include "animation/landing.h"

#include <algorithm>
#include <cmath>

#include "animation/shift_scale.h"

namespace skinforge {
namespace {

constexpr double kTurningDot =
    1 - 1.25e-5;                     // cosine of half of 0.01 radians; ours: as much as a still clip may have
constexpr float kLandingWeight = 2;  // ours: completion.md
constexpr std::size_t kMostTurning = 16;  // ours: more joints dilute a jolt and cost time
constexpr double kWandering = 0.01;       // ours: of the extent; less is a breathing joint, not a walk

// The joints that turn farthest from the first frame, farthest first.
std::vector<JointId> turning_joints(const MotionSet& set, std::span<const JointId> joints) {
  std::vector<std::pair<double, JointId>> turning;  // by |q . q'|, which falls as the angle grows
  for (const JointId j : joints) {
    double least = 1;
    const Quat& first = set.poses.front()[j.index()].rotation;
    for (const Pose& pose : set.poses) least = std::min(least, std::abs(first.dot(pose[j.index()].rotation)));
    if (least < kTurningDot) turning.push_back({least, j});
  }
  std::sort(turning.begin(), turning.end());
  turning.resize(std::min(turning.size(), kMostTurning));
  std::vector<JointId> result;
  for (const auto& [dot, j] : turning) result.push_back(j);
  return result;
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

LandingTable::LandingTable(const MotionSet& set, const Skeleton& skeleton, std::span<const JointId> joints,
                           const FrameSteps& steps)
    : steps_(steps), frames_(set.poses.size()), table_({}, {}), distances_(frames_), rows_(frames_) {
  if (frames_ == 0) return;
  const std::vector<JointId> turning = turning_joints(set, joints);
  turning_ = turning.size();
  rotations_ = rotations_at(set, turning);
  table_ = RotationTable(rotations_, std::vector<float>(turning_, 1.0F / static_cast<float>(turning_)));
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

const std::vector<float>& LandingTable::pose_distances(std::size_t frame) {
  std::vector<float>& distances = distances_[frame];
  if (!distances.empty()) return distances;
  distances.assign(turning_ > 0 ? table_.padded_count() : frames_, turning_ > 0 ? 0.0F : 1.0F);
  if (turning_ > 0)
    table_.add_similarities(std::span(rotations_).subspan(frame * turning_ * 4, turning_ * 4), distances);
  distances.resize(frames_);
  for (std::size_t c = 0; c < frames_; ++c) {
    double shift = 0;
    for (const auto& places : shifts_) shift = std::max(shift, (places[c] - places[frame]).squaredNorm());
    distances[c] = std::max(0.0F, 1 - distances[c]) + static_cast<float>(std::sqrt(shift));
  }
  return distances;
}

std::span<const float> LandingTable::row(std::int32_t from) {
  const auto s = static_cast<std::size_t>(from);
  std::vector<float>& row = rows_[s];
  if (!row.empty()) return row;
  const std::vector<float>& arrival =
      pose_distances(steps_.next[s] < 0 ? s : static_cast<std::size_t>(steps_.next[s]));
  const std::vector<float>& departure = pose_distances(s);
  row.resize(frames_);
  for (std::size_t t = 0; t < frames_; ++t) {
    const std::int32_t before = steps_.previous[t];
    row[t] =
        kLandingWeight * 0.5F * (arrival[t] + departure[before < 0 ? t : static_cast<std::size_t>(before)]);
  }
  return row;
}

}  // namespace skinforge
