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

// Interpolates between two keys at `steps` equal steps, the same way as players do.
class Between {
 public:
  Between(const Quat& from, const Quat& to, std::size_t steps)
      : from_(from.coeffs()), to_(to.coeffs()), steps_(steps) {
    const double dot = from_.dot(to_);
    if (dot < 0) to_ = -to_;
    const double angle = std::acos(std::min(1.0, std::abs(dot))) / static_cast<double>(steps);
    // sin((k + 1) a) = 2 cos(a) sin(k a) - sin((k - 1) a)
    sines_[1] = std::sin(angle);
    const double twice = 2 * std::cos(angle);
    for (std::size_t k = 2; k <= steps; ++k) sines_[k] = twice * sines_[k - 1] - sines_[k - 2];
    if (sines_[steps] >= kSinOfLine) return;
    for (std::size_t k = 0; k <= steps; ++k) sines_[k] = static_cast<double>(k);
  }
  Quat at(std::size_t step) const {
    return Quat(Vec4((sines_[steps_ - step] * from_ + sines_[step] * to_) / sines_[steps_]));
  }

 private:
  Vec4 from_, to_;
  std::size_t steps_;
  std::array<double, kLongest + 1> sines_ = {};
};

class Line {
 public:
  Line(const Vec3& from, const Vec3& to, std::size_t steps)
      : from_(from), step_((to - from) / static_cast<double>(steps)) {}
  Vec3 at(std::size_t step) const { return from_ + static_cast<double>(step) * step_; }

 private:
  Vec3 from_, step_;
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
  const Segment segment(track.values[from], track.values[to], to - from);
  for (std::size_t k = from + 1; k < to; ++k)
    if (!is_near(segment.at(k - from), track.values[k], tolerance)) return false;
  return true;
}

// From each key as far as it goes. In a loop the keys beside its ends stay, too: what passes the seam has the
// speed there that it had, while inside a clip a longer step may take its mean. `show(k, value)`: what is
// seen at each key of the track now.
template <class Segment, class Value, class Show>
Track<Value> thinned(const Track<Value>& track, double tolerance, bool is_loop, const Show& show) {
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
    const Segment segment(track.values[from], track.values[to], to - from);
    for (std::size_t k = from + 1; k < to; ++k) show(k, segment.at(k - from));
    show(to, track.values[to]);
    from = to;
  }
  return kept;
}

// What the skin does at all times: where all joints are, and of those that may move otherwise their balls.
class PosedSkin {
 public:
  PosedSkin(const Skeleton& skeleton, std::span<const double> radii, const std::vector<bool>& is_reducible,
            const std::vector<Pose>& poses);

  // The largest distance between the same points of the skin as it was and in `poses`, which differ in
  // reducible joints only: the center of a ball and the farthest that its surface may be from there, by the
  // norm of what moves it.
  double largest_move(const std::vector<Pose>& poses) const;

 private:
  const Skeleton& skeleton_;
  std::vector<bool> moves_;    // reducible joints and all below them
  std::vector<Mat3> axes_;     // per joint: three points on its ball, in the joint's own frame
  std::vector<Affine3> were_;  // #times x #joints
};

PosedSkin::PosedSkin(const Skeleton& skeleton, std::span<const double> radii,
                     const std::vector<bool>& is_reducible, const std::vector<Pose>& poses)
    : skeleton_(skeleton), moves_(is_reducible) {
  for (std::size_t j = 0; j < skeleton.size(); ++j) {
    const JointId parent = skeleton.joints[j].parent;
    if (parent.is_valid() && moves_[parent.index()]) moves_[j] = true;
    axes_.push_back(skeleton.joints[j].joint_from_model.linear() * radii[j]);
  }
  were_.reserve(poses.size() * skeleton.size());
  for (const Pose& pose : poses) {
    const std::vector<Affine3> placed = model_from_joint(skeleton, pose);
    were_.insert(were_.end(), placed.begin(), placed.end());
  }
}

double PosedSkin::largest_move(const std::vector<Pose>& poses) const {
  double largest = 0;
  const std::size_t n = skeleton_.size();
  std::vector<Affine3> are(n);
  for (std::size_t t = 0; t < poses.size(); ++t) {
    const Affine3* were = were_.data() + t * n;
    for (std::size_t j = 0; j < n; ++j) {
      if (!moves_[j]) continue;
      const JointId parent = skeleton_.joints[j].parent;
      const bool is_below = parent.is_valid() && moves_[parent.index()];
      are[j] = poses[t][j].matrix();
      if (parent.is_valid()) are[j] = (is_below ? are.data() : were)[parent.index()] * are[j];
      const double center2 = (are[j].translation() - were[j].translation()).squaredNorm();
      const double around2 = ((are[j].linear() - were[j].linear()) * axes_[j]).squaredNorm();
      if (2 * (center2 + around2) <= largest * largest) continue;  // no less than the square of their sum
      largest = std::max(largest, std::sqrt(center2) + std::sqrt(around2));
    }
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

// Tracks with a key at each time need no interpolation.
template <class Value>
void sample_into(const Track<Value>& track, std::span<const double> times, std::size_t joint,
                 Value Transform::*part, std::vector<Pose>& poses) {
  if (track.is_empty()) return;
  const bool is_keyed = track.interpolation == Interpolation::Linear &&
                        std::equal(times.begin(), times.end(), track.times.begin(), track.times.end());
  for (std::size_t t = 0; t < times.size(); ++t)
    poses[t][joint].*part = is_keyed ? track.values[t] : sample(track, times[t]);
}

void sample_into(const JointTracks& tracks, std::span<const double> times, std::vector<Pose>& poses) {
  const std::size_t j = tracks.joint.index();
  sample_into(tracks.translation, times, j, &Transform::translation, poses);
  sample_into(tracks.rotation, times, j, &Transform::rotation, poses);
  sample_into(tracks.scale, times, j, &Transform::scale, poses);
}

// The tracks of one joint with fewer keys; `poses` show them. A completed track has a key at every time, or
// one.
JointTracks thinned(const JointTracks& tracks, double shift, double turn, bool is_loop,
                    std::vector<Pose>& poses) {
  const std::size_t j = tracks.joint.index();
  const auto show = [&](auto part) {
    return [&poses, part, j](std::size_t k, const auto& value) { poses[k][j].*part = value; };
  };
  return {tracks.joint, thinned<Line>(tracks.translation, shift, is_loop, show(&Transform::translation)),
          thinned<Between>(tracks.rotation, turn, is_loop, show(&Transform::rotation)),
          thinned<Line>(tracks.scale, turn, is_loop, show(&Transform::scale))};
}

}  // namespace

void reduce_keys(Clip& clip, const Skeleton& skeleton, const std::vector<bool>& is_reducible,
                 std::span<const double> times, std::span<const double> radii, double tolerance,
                 bool is_loop) {
  if (tolerance <= 0 || times.size() < 3) return;
  std::vector<Pose> poses(times.size(), bind_pose(skeleton));
  for (const JointTracks& tracks : clip.joints) sample_into(tracks, times, poses);
  const PosedSkin skin(skeleton, radii, is_reducible, poses);
  const std::vector<double> reaches = reaches_of(skeleton, radii);
  double share = 1;
  for (int attempt = 0; attempt < kTries; ++attempt) {
    std::vector<JointTracks> reduced;
    for (const JointTracks& tracks : clip.joints) {
      if (!is_reducible[tracks.joint.index()]) continue;
      const double reach = std::max(reaches[tracks.joint.index()], tolerance), moves = share * tolerance;
      reduced.push_back(
          thinned(tracks, moves / scale_of_parent(skeleton, tracks.joint), moves / reach, is_loop, poses));
    }
    const double moved = skin.largest_move(poses);
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
