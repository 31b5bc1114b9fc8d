#include "animation/landing.h"

#include <algorithm>
#include <cmath>

#include "animation/shift_scale.h"

namespace skinforge {
namespace {

constexpr double kTurningDot =
    1 - 1.25e-5;                     // cosine of half of 0.01 radians; ours: as much as a still clip may have
constexpr float kLandingWeight = 2;  // ours: completion.md
constexpr std::size_t kMostTurning = 16;          // ours: more joints dilute a jolt and cost time
constexpr std::size_t kKeptNumbers = 24'000'000;  // ours: 96 MB of rows and pose distances
constexpr double kWandering = 0.01;  // ours: of the extent; less is a breathing joint, not a walk

// The joints that turn farthest from the first frame, farthest first.
std::vector<JointId> turning_joints(const MotionSet& set, std::span<const JointId> joints) {
  std::vector<std::pair<double, JointId>> turning;
  for (const JointId j : joints)
    if (set.ranges[j.index()].turn < kTurningDot) turning.push_back({set.ranges[j.index()].turn, j});
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

std::vector<JointRange> joint_ranges(std::span<const Pose> poses, const Skeleton& skeleton) {
  std::vector<JointRange> ranges(skeleton.size());
  for (const Pose& pose : poses)
    for (std::size_t j = 0; j < ranges.size(); ++j) {
      const Transform &first = poses.front()[j], &now = pose[j];
      ranges[j].turn = std::min(ranges[j].turn, std::abs(first.rotation.dot(now.rotation)));
      ranges[j].shift = std::max(ranges[j].shift, (now.translation - first.translation).squaredNorm());
    }
  const std::vector<double> scales = shift_scales(skeleton);
  for (std::size_t j = 0; j < ranges.size(); ++j) ranges[j].shift = scales[j] * std::sqrt(ranges[j].shift);
  return ranges;
}

LandingTable::LandingTable(const MotionSet& set, const Skeleton& skeleton, std::span<const JointId> joints,
                           const FrameSteps& steps)
    : steps_(steps), frames_(set.poses.size()), table_({}, {}), distances_(frames_), rows_(frames_) {
  if (frames_ == 0) return;
  const std::vector<JointId> turning = turning_joints(set, joints);
  turning_ = turning.size();
  rotations_ = rotations_at(set, turning);
  table_ = RotationTable(rotations_, std::vector<float>(turning_, 1.0F / static_cast<float>(turning_)));
  for (std::size_t t = 0; t < frames_; ++t)
    if (t == 0 || steps.previous[t] != static_cast<std::int32_t>(t - 1)) first_frames_.push_back(t);
  const std::vector<double> scales = shift_scales(skeleton);
  for (const JointId j : joints) {
    if (set.ranges[j.index()].shift <= kWandering) continue;
    Eigen::ArrayX3f& places = shifts_.emplace_back(frames_, 3);
    for (std::size_t f = 0; f < frames_; ++f)
      places.row(static_cast<Eigen::Index>(f)) =
          (scales[j.index()] * set.poses[f][j.index()].translation).cast<float>();
  }
}

const Eigen::ArrayXf& LandingTable::pose_distances(std::size_t frame) {
  if (distances_[frame].size() == 0) {
    const std::size_t first = frame / RotationTable::kAtOnce * RotationTable::kAtOnce;
    compare_poses(first, std::min(RotationTable::kAtOnce, frames_ - first));
  }
  return distances_[frame];
}

// A few neighbours at once, because that costs no more, and they are likely to be asked for, too.
void LandingTable::compare_poses(std::size_t first, std::size_t count) {
  const std::size_t stride = turning_ * 4, padded = table_.padded_count();
  std::vector<float> similarities(count * padded, 0.0F);
  if (turning_ > 0)
    table_.add_similarities(std::span(rotations_).subspan(first * stride, count * stride), similarities);
  for (std::size_t k = 0; k < count; ++k) {
    Eigen::ArrayXf& distances = distances_[first + k];
    distances = Eigen::ArrayXf::Zero(static_cast<Eigen::Index>(frames_));
    if (turning_ > 0)
      distances = (1 - Eigen::Map<const Eigen::ArrayXf>(similarities.data() + k * padded, distances.size()))
                      .max(0.0F);
    add_shift(first + k);
  }
  kept_ += count * frames_;
}

void LandingTable::add_shift(std::size_t frame) {
  if (shifts_.empty()) return;
  const auto here = static_cast<Eigen::Index>(frame);
  Eigen::ArrayXf farthest = Eigen::ArrayXf::Zero(static_cast<Eigen::Index>(frames_));
  for (const Eigen::ArrayX3f& p : shifts_)
    farthest = farthest.max((p.col(0) - p(here, 0)).square() + (p.col(1) - p(here, 1)).square() +
                            (p.col(2) - p(here, 2)).square());
  distances_[frame] += farthest.sqrt();
}

// Long sets would keep a square table otherwise.
void LandingTable::make_room() {
  if (kept_ <= kKeptNumbers) return;
  kept_ = 0;
  std::fill(rows_.begin(), rows_.end(), Eigen::ArrayXf());
  std::fill(distances_.begin(), distances_.end(), Eigen::ArrayXf());
}

std::span<const float> LandingTable::row(std::int32_t from) {
  const auto s = static_cast<std::size_t>(from);
  Eigen::ArrayXf& row = rows_[s];
  if (row.size() > 0) return {row.data(), frames_};
  make_room();
  const Eigen::ArrayXf& arrival =
      pose_distances(steps_.next[s] < 0 ? s : static_cast<std::size_t>(steps_.next[s]));
  const Eigen::ArrayXf& departure = pose_distances(s);
  const auto rest = static_cast<Eigen::Index>(frames_) - 1;
  row.resize(rest + 1);
  row.tail(rest) = arrival.tail(rest) + departure.head(rest);
  for (const std::size_t t : first_frames_) {
    const std::int32_t before = steps_.previous[t];
    const auto here = static_cast<Eigen::Index>(t);
    row[here] = arrival[here] + departure[before < 0 ? here : before];
  }
  row *= kLandingWeight * 0.5F;
  kept_ += frames_;
  return {row.data(), frames_};
}

}  // namespace skinforge
