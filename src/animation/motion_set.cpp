#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "animation/completion.h"
#include "animation/resampling.h"
#include "animation/sampling.h"
#include "animation/shift_scale.h"
#include "base/expect.h"

namespace skinforge {
namespace {

constexpr double kLoopGap = 0.05;      // ours: of the clip's own range; real loops close to 1e-3
constexpr double kStillAngle = 0.01;   // radians; ours: a joint that turns less does not count as moving
constexpr double kStillShift = 0.002;  // ours: of the skeleton's extent

// How far the joints of a range of frames stray from its first frame.
struct Range {
  double angle = 0;  // largest over frames and joints, radians
  double shift = 0;  // largest translation, of the skeleton's extent

  void include(const Transform& first, const Transform& now, double shift_scale) {
    angle = std::max(angle, first.rotation.angularDistance(now.rotation));
    shift = std::max(shift, shift_scale * (now.translation - first.translation).norm());
  }
};

// Joints to look at, and the shift scale of every joint.
struct Watched {
  std::vector<JointId> joints;
  const std::vector<double>& shift_scale;
};

Range range_of(std::span<const Pose> poses, const Watched& watched) {
  Range range;
  for (const Pose& pose : poses)
    for (const JointId j : watched.joints)
      range.include(poses.front()[j.index()], pose[j.index()], watched.shift_scale[j.index()]);
  return range;
}

std::vector<JointId> all_joints(std::size_t count) {
  std::vector<JointId> joints;
  for (std::size_t j = 0; j < count; ++j) joints.push_back(JointId(j));
  return joints;
}

std::vector<JointId> kept_joints(const GraftSource& source) {
  std::vector<JointId> joints;
  for (std::size_t j = 0; j < source.result_joint.size(); ++j)
    if (source.result_joint[j].is_valid()) joints.push_back(JointId(j));
  return joints;
}

bool is_loop(std::span<const Pose> poses, const Watched& watched) {
  if (poses.size() < 4) return false;  // too few frames to tell
  const Range whole = range_of(poses, watched);
  Range gap;
  for (const JointId j : watched.joints)
    gap.include(poses.front()[j.index()], poses.back()[j.index()], watched.shift_scale[j.index()]);
  return gap.angle <= kLoopGap * whole.angle && gap.shift <= kLoopGap * whole.shift;
}

// Angle per second between neighbouring frames, largest over the joints.
double fastest_turn_of(std::span<const Pose> poses, double step) {
  double fastest = 0;
  for (std::size_t f = 1; f < poses.size(); ++f)
    for (std::size_t j = 0; j < poses[f].size(); ++j)
      fastest = std::max(fastest, poses[f - 1][j].rotation.angularDistance(poses[f][j].rotation) / step);
  return fastest;
}

void resample_clips(const Character& input, double rate_hz, std::vector<JointId> kept, MotionSet& set) {
  const std::vector<double> shift_scale = shift_scales(input.skeleton);
  const Watched all{all_joints(input.skeleton.size()), shift_scale}, part{std::move(kept), shift_scale};
  for (const Clip& clip : input.clips) {
    const std::size_t first = set.poses.size();
    const ClipFrames frames(clip.duration, rate_hz);
    for (std::size_t f = 0; f < frames.count; ++f) {
      set.frame_time.push_back(frames.time(f));
      set.poses.push_back(sample(input.skeleton, clip, frames.time(f)));
    }
    set.clip_begin.push_back(static_cast<std::int32_t>(set.poses.size()));
    const auto poses = std::span<const Pose>(set.poses).subspan(first);
    const Range moved = range_of(poses, part);
    set.is_cyclic.push_back(is_loop(poses, all));
    set.is_moving.push_back(moved.angle > kStillAngle || moved.shift > kStillShift);
    set.fastest_turn = std::max(set.fastest_turn, fastest_turn_of(poses, frames.step()));
  }
}

// Global rotations relative to the bind pose, g * g_bind^-1, as they look once placed. One per input joint.
std::vector<Quat> rotations_from_bind(const Skeleton& skeleton, const Pose& pose, std::span<const Quat> bind,
                                      const Quat& placement) {
  std::vector<Quat> rotations = global_rotations(skeleton, pose);
  for (std::size_t j = 0; j < rotations.size(); ++j)
    rotations[j] = placement * rotations[j] * bind[j].conjugate() * placement.conjugate();
  return rotations;
}

// The rotation that the given ones have in common: the largest eigenvector of the sum of q q^T, which does
// not care for the signs of the q.
class MeanRotation {
 public:
  void add(const Quat& q, double weight) { sum_ += weight * q.coeffs() * q.coeffs().transpose(); }
  Quat get() const {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> solver(sum_);
    return Quat(Vec4(solver.eigenvectors().col(3))).normalized();
  }

 private:
  Eigen::Matrix4d sum_ = Eigen::Matrix4d::Zero();
};

// Mean of the rotations that the map brings to one result joint, by confidence.
Quat mean_on_image(std::span<const Quat> rotations, const JointMap& map, std::span<const JointId> sources) {
  const Quat& first = rotations[sources.front().index()];
  if (sources.size() == 1) return first;
  Vec4 sum = Vec4::Zero();
  for (const JointId j : sources) {
    const Quat& q = rotations[j.index()];
    sum += (q.dot(first) < 0 ? -1 : 1) * map[j.index()].confidence * q.coeffs();
  }
  return sum.norm() > 0 ? Quat(sum).normalized() : first;
}

// For each result joint the input joints that the map brings there with some confidence.
std::vector<std::vector<JointId>> joints_by_image(const JointMap& map, std::size_t result_size) {
  std::vector<std::vector<JointId>> sources(result_size);
  for (std::size_t j = 0; j < map.size(); ++j)
    if (map[j].confidence > 0) sources[map[j].image.index()].push_back(JointId(j));
  return sources;
}

}  // namespace

MotionSet build_motion_set(const Character& input, const Graft& graft, SourceId source, const JointMap& map,
                           const CompletionOptions& options) {
  SF_EXPECT(map.size() == input.skeleton.size() && options.rate_hz > 0);
  const GraftSource& placed = graft.sources[source.index()];
  const std::size_t result_size = graft.skeleton.size();
  MotionSet set;
  resample_clips(input, options.rate_hz, kept_joints(placed), set);

  const std::vector<Quat> bind = global_rotations(input.skeleton, bind_pose(input.skeleton));
  std::vector<std::vector<Quat>> rotations;
  MeanRotation mean;
  for (const Pose& pose : set.poses) {
    rotations.push_back(rotations_from_bind(input.skeleton, pose, bind, placed.model_from_input.rotation));
    for (const Quat& q : rotations.back()) mean.add(q, 1);
  }
  const auto sources = joints_by_image(map, result_size);
  set.confidence.assign(result_size, 0.0);
  for (const MappedJoint& m : map) set.confidence[m.image.index()] += m.confidence;
  if (set.poses.empty()) return set;

  const Quat from_mean = mean.get().conjugate();
  set.rotations.reserve(set.poses.size() * result_size * 4);
  for (const auto& frame : rotations)
    for (const auto& joints : sources) {
      const Quat q = joints.empty() ? Quat::Identity() : from_mean * mean_on_image(frame, map, joints);
      for (int k = 0; k < 4; ++k) set.rotations.push_back(static_cast<float>(q.coeffs()[k]));
    }
  return set;
}

}  // namespace skinforge
