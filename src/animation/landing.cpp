#include "animation/landing.h"

#include <algorithm>
#include <cmath>

#include "animation/shift_scale.h"

namespace skinforge {
namespace {

constexpr double kTurningDot =
    1 - 1.25e-5;                     // cosine of half of 0.01 radians; ours: as much as a still clip may have
constexpr float kLandingWeight = 2;  // ours: completion.md
constexpr std::size_t kMostTurning = 16;         // ours: more joints dilute a jolt and cost time
constexpr std::size_t kKeptNumbers = 8'000'000;  // ours: 32 MB of rows, and twice that of pose distances
constexpr double kWandering = 0.01;              // ours: of the extent; less is a breathing joint, not a walk

// The joints that turn farthest from the first frame, farthest first.
std::vector<JointId> turning_joints(const MotionSet& set, std::span<const JointId> joints) {
  std::vector<double> least(joints.size(), 1);  // |q . q'|, which falls as the angle grows
  const Pose& first = set.poses.front();
  for (const Pose& pose : set.poses)
    for (std::size_t k = 0; k < joints.size(); ++k) {
      const std::size_t j = joints[k].index();
      least[k] = std::min(least[k], std::abs(first[j].rotation.dot(pose[j].rotation)));
    }
  std::vector<std::pair<double, JointId>> turning;
  for (std::size_t k = 0; k < joints.size(); ++k)
    if (least[k] < kTurningDot) turning.push_back({least[k], joints[k]});
  std::sort(turning.begin(), turning.end());
  turning.resize(std::min(turning.size(), kMostTurning));
  std::vector<JointId> result;
  for (const auto& [dot, j] : turning) result.push_back(j);
  return result;
}

struct Wandering {
  JointId joint;
  double scale;  // of its translation to shares of the extent
};

// The joints that move, within their parents, away from where they are in the first frame.
std::vector<Wandering> wandering_joints(const MotionSet& set, const Skeleton& skeleton,
                                        std::span<const JointId> joints) {
  std::vector<double> farthest2(joints.size(), 0);
  const Pose& first = set.poses.front();
  for (const Pose& pose : set.poses)
    for (std::size_t k = 0; k < joints.size(); ++k) {
      const std::size_t j = joints[k].index();
      farthest2[k] = std::max(farthest2[k], (pose[j].translation - first[j].translation).squaredNorm());
    }
  const std::vector<double> scales = shift_scales(skeleton);
  std::vector<Wandering> result;
  for (std::size_t k = 0; k < joints.size(); ++k) {
    const double scale = scales[joints[k].index()];
    if (scale * std::sqrt(farthest2[k]) > kWandering) result.push_back({joints[k], scale});
  }
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
  for (const auto& [joint, scale] : wandering_joints(set, skeleton, joints)) {
    Eigen::ArrayX3f& places = shifts_.emplace_back(frames_, 3);
    for (std::size_t f = 0; f < frames_; ++f)
      places.row(static_cast<Eigen::Index>(f)) =
          (scale * set.poses[f][joint.index()].translation).cast<float>();
  }
}

const Eigen::ArrayXf& LandingTable::pose_distances(std::size_t frame) {
  Eigen::ArrayXf& distances = distances_[frame];
  if (distances.size() > 0) return distances;
  const auto count = static_cast<Eigen::Index>(frames_), here = static_cast<Eigen::Index>(frame);
  distances = Eigen::ArrayXf::Zero(count);
  for (const Eigen::ArrayX3f& p : shifts_)
    distances = distances.max((p.col(0) - p(here, 0)).square() + (p.col(1) - p(here, 1)).square() +
                              (p.col(2) - p(here, 2)).square());
  distances = distances.sqrt();
  if (turning_ == 0) return distances;
  std::vector<float> similarities(table_.padded_count(), 0.0F);
  table_.add_similarities(std::span(rotations_).subspan(frame * turning_ * 4, turning_ * 4), similarities);
  distances += (1 - Eigen::Map<const Eigen::ArrayXf>(similarities.data(), count)).max(0.0F);
  return distances;
}

// Long sets would keep a square table otherwise.
void LandingTable::make_room() {
  if (++kept_ * frames_ <= kKeptNumbers) return;
  kept_ = 1;
  std::fill(rows_.begin(), rows_.end(), std::vector<float>());
  std::fill(distances_.begin(), distances_.end(), Eigen::ArrayXf());
}

std::span<const float> LandingTable::row(std::int32_t from) {
  const auto s = static_cast<std::size_t>(from);
  std::vector<float>& row = rows_[s];
  if (!row.empty()) return row;
  make_room();
  const Eigen::ArrayXf& arrival =
      pose_distances(steps_.next[s] < 0 ? s : static_cast<std::size_t>(steps_.next[s]));
  const Eigen::ArrayXf& departure = pose_distances(s);
  row.resize(frames_);
  for (std::size_t t = 0; t < frames_; ++t) {
    const std::int32_t before = steps_.previous[t];
    row[t] =
        kLandingWeight * 0.5F * (arrival[t] + departure[before < 0 ? t : static_cast<std::size_t>(before)]);
  }
  return row;
}

}  // namespace skinforge
