#include "animation/key_reduction.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "animation/sampling.h"

namespace skinforge {
namespace {

constexpr std::size_t kLongest = 30;  // ours: keys that one step may pass over; keeps the search linear
constexpr int kTries = 6;             // ours: most clips need one or two
constexpr double kSafer = 0.7;        // ours: below the share of the tolerance that the last try left
constexpr double kSinOfLine = 1e-9;   // turns so small are interpolated in a line

// Interpolates between two keys, the same way as players do.
class Between {
 public:
  Between(const Quat& from, const Quat& to) : from_(from.coeffs()), to_(to.coeffs()) {
    const double dot = from_.dot(to_);
    if (dot < 0) to_ = -to_;
    angle_ = std::acos(std::min(1.0, std::abs(dot)));
    sine_ = std::sin(angle_);
  }
  Quat at(double share) const {
    if (sine_ < kSinOfLine) return Quat(Vec4((1 - share) * from_ + share * to_));
    return Quat(Vec4((std::sin((1 - share) * angle_) * from_ + std::sin(share * angle_) * to_) / sine_));
  }

 private:
  Vec4 from_, to_;
  double angle_ = 0, sine_ = 0;
};

struct Line {
  Line(const Vec3& a, const Vec3& b) : from(a), to(b) {}
  Vec3 at(double share) const { return (1 - share) * from + share * to; }
  Vec3 from, to;
};

// Of radians, or of metres.
bool is_near(const Quat& a, const Quat& b, double tolerance) {
  return 1 - std::abs(a.dot(b)) <= 1 - std::cos(std::min(tolerance, 1.0) / 2);
}
bool is_near(const Vec3& a, const Vec3& b, double tolerance) {
  return (a - b).squaredNorm() <= tolerance * tolerance;
}

template <class Segment, class Value>
bool passes(const Track<Value>& track, std::size_t from, std::size_t to, double tolerance) {
  const Segment segment(track.values[from], track.values[to]);
  const double length = track.times[to] - track.times[from];
  for (std::size_t k = from + 1; k < to; ++k)
    if (!is_near(segment.at((track.times[k] - track.times[from]) / length), track.values[k], tolerance))
      return false;
  return true;
}

// From each key as far as it goes. In a loop the keys beside its ends stay, too: what passes the seam has the
// speed there that it had, while inside a clip a longer step may take its mean.
template <class Segment, class Value>
Track<Value> thinned(const Track<Value>& track, double tolerance, bool is_loop) {
  if (track.times.size() < 3) return track;
  const std::size_t last = track.times.size() - 1;
  const auto stays = [&](std::size_t k) { return is_loop && (k == 1 || k == last - 1); };
  Track<Value> kept{track.interpolation, {track.times.front()}, {track.values.front()}};
  for (std::size_t from = 0; from < last;) {
    std::size_t to = from + 1;
    while (to < last && !stays(to) && to - from < kLongest && passes<Segment>(track, from, to + 1, tolerance))
      ++to;
    kept.times.push_back(track.times[to]);
    kept.values.push_back(track.values[to]);
    from = to;
  }
  return kept;
}

struct Worlds {
  std::vector<Affine3> joints;  // #times x #joints
};

// Where all joints are at all times, with the tracks that may lose keys taken from `reduced`.
Worlds worlds_of(const Skeleton& skeleton, const std::vector<Pose>& poses) {
  Worlds worlds;
  worlds.joints.reserve(poses.size() * skeleton.size());
  for (const Pose& pose : poses)
    for (std::size_t j = 0; j < skeleton.size(); ++j) {
      const JointId parent = skeleton.joints[j].parent;
      const Affine3 local = pose[j].matrix();
      const std::size_t frame = worlds.joints.size() - j;
      worlds.joints.push_back(parent.is_valid() ? worlds.joints[frame + parent.index()] * local : local);
    }
  return worlds;
}

// Skin around a joint: three points on its ball, in the joint's own frame.
struct Ball {
  Eigen::Matrix3d axes;
};

std::vector<Ball> balls_of(const Skeleton& skeleton, std::span<const double> radii) {
  std::vector<Ball> balls;
  for (std::size_t j = 0; j < skeleton.size(); ++j)
    balls.push_back({skeleton.joints[j].joint_from_model.linear() * radii[j]});
  return balls;
}

// The largest distance between the same points of the skin: the center of a ball and the farthest that its
// surface may be from there, by the norm of what moves it.
double largest_move(const Worlds& a, const Worlds& b, const std::vector<Ball>& balls) {
  double largest = 0;
  for (std::size_t i = 0; i < a.joints.size(); ++i) {
    const Ball& ball = balls[i % balls.size()];
    const double center = (a.joints[i].translation() - b.joints[i].translation()).norm();
    const double around = ((a.joints[i].linear() - b.joints[i].linear()) * ball.axes).norm();
    largest = std::max(largest, center + around);
  }
  return largest;
}

// How far from each joint anything lies that follows it.
std::vector<double> reaches_of(const Skeleton& skeleton, std::span<const double> radii) {
  std::vector<Vec3> places;
  for (const Joint& joint : skeleton.joints) places.push_back(joint.joint_from_model.inverse().translation());
  std::vector<double> reaches(radii.begin(), radii.end());
  for (std::size_t j = skeleton.size(); j-- > 0;) {
    const JointId parent = skeleton.joints[j].parent;
    if (!parent.is_valid()) continue;
    double& reach = reaches[parent.index()];
    reach = std::max(reach, reaches[j] + (places[j] - places[parent.index()]).norm());
  }
  return reaches;
}

// What a length in the frame of a joint's parent is in the model.
double scale_of_parent(const Skeleton& skeleton, JointId joint) {
  const JointId parent = skeleton[joint].parent;
  if (!parent.is_valid()) return 1;
  return 1 / std::cbrt(std::abs(skeleton[parent].joint_from_model.linear().determinant()));
}

void sample_into(const JointTracks& tracks, std::span<const double> times, std::vector<Pose>& poses) {
  for (std::size_t t = 0; t < times.size(); ++t) {
    Transform& local = poses[t][tracks.joint.index()];
    if (!tracks.translation.is_empty()) local.translation = sample(tracks.translation, times[t]);
    if (!tracks.rotation.is_empty()) local.rotation = sample(tracks.rotation, times[t]);
    if (!tracks.scale.is_empty()) local.scale = sample(tracks.scale, times[t]);
  }
}

}  // namespace

void reduce_keys(Clip& clip, const Skeleton& skeleton, const std::vector<bool>& is_reducible,
                 std::span<const double> times, std::span<const double> radii, double tolerance,
                 bool is_loop) {
  if (tolerance <= 0 || times.size() < 3) return;
  std::vector<Pose> poses(times.size(), bind_pose(skeleton));
  for (const JointTracks& tracks : clip.joints) sample_into(tracks, times, poses);
  const Worlds wanted = worlds_of(skeleton, poses);
  const std::vector<Ball> balls = balls_of(skeleton, radii);
  const std::vector<double> reaches = reaches_of(skeleton, radii);
  double share = 1;
  for (int attempt = 0; attempt < kTries; ++attempt) {
    std::vector<JointTracks> reduced;
    for (const JointTracks& tracks : clip.joints) {
      if (!is_reducible[tracks.joint.index()]) continue;
      const double reach = std::max(reaches[tracks.joint.index()], tolerance), moves = share * tolerance;
      reduced.push_back(
          {tracks.joint,
           thinned<Line>(tracks.translation, moves / scale_of_parent(skeleton, tracks.joint), is_loop),
           thinned<Between>(tracks.rotation, moves / reach, is_loop),
           thinned<Line>(tracks.scale, moves / reach, is_loop)});
      sample_into(reduced.back(), times, poses);
    }
    const double moved = largest_move(wanted, worlds_of(skeleton, poses), balls);
    if (moved <= tolerance) {
      for (JointTracks& tracks : reduced)
        *std::find_if(clip.joints.begin(), clip.joints.end(),
                      [&](const JointTracks& t) { return t.joint == tracks.joint; }) = std::move(tracks);
      return;
    }
    share *= kSafer * tolerance / moved;
  }
}

}  // namespace skinforge
