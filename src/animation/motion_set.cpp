#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "animation/completion.h"
#include "animation/feet.h"
#include "animation/key_rate.h"
#include "animation/landing.h"
#include "animation/loop_closing.h"
#include "animation/resampling.h"
#include "animation/sampling.h"
#include "animation/shift_scale.h"
#include "animation/skin_balls.h"
#include "base/expect.h"

namespace skinforge {
namespace {

constexpr double kLoopGap = 0.25;             // ours: of the clip's own range; completion.md
constexpr double kActivityHalfWindow = 0.25;  // seconds; ours: about half a step of a walk
constexpr double kHangingRadius = 0.05;       // ours: of the skeleton's diagonal; a tool in a hand
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

void close_loop(std::span<Pose> poses) {
  const Pose first = poses.front(), last = poses.back();
  for (std::size_t f = 0; f < poses.size(); ++f) {
    const double place = static_cast<double>(f) / static_cast<double>(poses.size() - 1);
    for (std::size_t j = 0; j < first.size(); ++j)
      poses[f][j] = closed(poses[f][j], first[j], last[j], place);
  }
  poses.back() = poses.front();
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
    set.fastest_turn =
        std::max({set.fastest_turn, fastest_turn_of(poses, frames.step()), fastest_keyed_turn(clip)});
    if (set.is_cyclic.back()) close_loop(std::span<Pose>(set.poses).subspan(first));
  }
}

// Mean angular speed of the joints around each frame of a clip, radians per frame.
std::vector<double> speeds_of(std::span<const Pose> poses) {
  std::vector<double> speed(poses.size(), 0.0);
  for (std::size_t f = 1; f < poses.size(); ++f) {
    for (std::size_t j = 0; j < poses[f].size(); ++j)
      speed[f] += poses[f - 1][j].rotation.angularDistance(poses[f][j].rotation);
    speed[f] /= static_cast<double>(poses[f].size());
  }
  if (poses.size() > 1) speed[0] = speed[1];
  return speed;
}

double mean_of(std::span<const double> values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return values.empty() ? 0 : sum / static_cast<double>(values.size());
}

// Liveliness of each frame: mean joint speed over half a second, 1 = the liveliest clip's mean.
void measure_activity(double rate_hz, MotionSet& set) {
  const auto half = static_cast<std::ptrdiff_t>(std::lround(kActivityHalfWindow * rate_hz));
  double liveliest = 0;
  std::vector<double> activity;
  for (std::size_t c = 0; c + 1 < set.clip_begin.size(); ++c) {
    const auto first = static_cast<std::size_t>(set.clip_begin[c]);
    const auto count = static_cast<std::ptrdiff_t>(set.clip_begin[c + 1]) - set.clip_begin[c];
    const auto speeds =
        speeds_of(std::span<const Pose>(set.poses).subspan(first, static_cast<std::size_t>(count)));
    liveliest = std::max(liveliest, mean_of(speeds));
    const bool wraps = set.is_cyclic[c];
    for (std::ptrdiff_t f = 0; f < count; ++f) {
      double sum = 0;
      for (std::ptrdiff_t k = f - half; k <= f + half; ++k)
        sum += speeds[static_cast<std::size_t>(wraps ? ((k % count) + count) % count
                                                     : std::clamp<std::ptrdiff_t>(k, 0, count - 1))];
      activity.push_back(sum / static_cast<double>(2 * half + 1));
    }
  }
  for (const double a : activity)
    set.activity.push_back(liveliest > 0 ? static_cast<float>(a / liveliest) : 0.0F);
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

// Per frame of the set, how much it weighs in a mean that counts every clip alike.
std::vector<double> clip_shares(const MotionSet& set) {
  std::vector<double> shares;
  for (std::size_t c = 0; c + 1 < set.clip_begin.size(); ++c) {
    const std::int32_t count = set.clip_begin[c + 1] - set.clip_begin[c];
    shares.insert(shares.end(), static_cast<std::size_t>(count), 1.0 / count);
  }
  return shares;
}

// Takes out what the frames have in common: the turn of the whole body (left factor: an input whose clips
// face another way than its bind pose), then each joint's own mean (right factor: its usual stance).
void relate_to_means(std::span<const double> shares, std::vector<std::vector<Quat>>& rotations) {
  MeanRotation body;
  for (std::size_t f = 0; f < rotations.size(); ++f)
    for (const Quat& q : rotations[f]) body.add(q, shares[f]);
  const Quat from_body = body.get().conjugate();
  for (std::size_t j = 0; j < rotations.front().size(); ++j) {
    MeanRotation stance;
    for (std::size_t f = 0; f < rotations.size(); ++f) {
      rotations[f][j] = from_body * rotations[f][j];
      stance.add(rotations[f][j], shares[f]);
    }
    const Quat from_stance = stance.get().conjugate();
    for (auto& frame : rotations) frame[j] = frame[j] * from_stance;
  }
}

std::vector<double> skin_radii(const Character& input) {
  Eigen::AlignedBox3d box;
  std::vector<Vec3> places;
  for (const Joint& joint : input.skeleton.joints) {
    places.push_back(joint.joint_from_model.inverse().translation());
    box.extend(places.back());
  }
  std::vector<double> radii(places.size(), 0.0);
  for (std::size_t v = 0; v < input.weights.vertex_count(); ++v)
    for (const Influence& influence : input.weights.of(VertexId(v))) {
      double& radius = radii[influence.joint.index()];
      radius = std::max(radius, (input.mesh.positions[v] - places[influence.joint.index()]).norm());
    }
  const double hanging = kHangingRadius * (box.isEmpty() ? 0 : box.diagonal().norm());
  for (double& radius : radii) radius = radius == 0 ? hanging : radius;
  return radii;
}

}  // namespace

MotionSet build_motion_set(const Character& input, const Graft& graft, SourceId source, const JointMap& map) {
  SF_EXPECT(map.size() == input.skeleton.size());
  const GraftSource& placed = graft.sources[source.index()];
  const std::size_t result_size = graft.skeleton.size();
  MotionSet set;
  resample_clips(input, kSearchRate, kept_joints(placed), set);
  set.confidence.assign(result_size, 0.0);
  for (const MappedJoint& m : map) set.confidence[m.image.index()] += m.confidence;
  set.skin_radius = skin_radii(input);
  if (set.poses.empty()) return set;

  set.feet = find_feet(input, set);
  set.ranges = joint_ranges(set.poses, input.skeleton);
  set.balls = skin_balls(input, kept_joints(placed));
  set.seams = seam_balls(input, graft, source, set);
  measure_activity(kSearchRate, set);
  const std::vector<Quat> bind = global_rotations(input.skeleton, bind_pose(input.skeleton));
  std::vector<std::vector<Quat>> rotations;
  for (const Pose& pose : set.poses)
    rotations.push_back(rotations_from_bind(input.skeleton, pose, bind, placed.model_from_input.rotation));
  relate_to_means(clip_shares(set), rotations);

  const auto sources = joints_by_image(map, result_size);
  set.rotations.reserve(set.poses.size() * result_size * 4);
  for (const auto& frame : rotations)
    for (const auto& joints : sources) {
      const Quat q = joints.empty() ? Quat::Identity() : mean_on_image(frame, map, joints);
      for (int k = 0; k < 4; ++k) set.rotations.push_back(static_cast<float>(q.coeffs()[k]));
    }
  return set;
}

}  // namespace skinforge
