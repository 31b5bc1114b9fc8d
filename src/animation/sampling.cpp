#include "animation/sampling.h"

#include <algorithm>

#include "base/expect.h"

namespace skinforge {
namespace {

// Where a time lies among keys: between `key` and `key + 1` at `fraction`, or on `key` exactly.
struct KeySpan {
  std::size_t key = 0;
  double fraction = 0;
  double length = 0;  // seconds; 0 when the key alone holds
};

KeySpan find_span(const std::vector<double>& times, double time) {
  const auto after = std::upper_bound(times.begin(), times.end(), time);
  if (after == times.begin()) return {};
  const auto key = static_cast<std::size_t>(after - times.begin()) - 1;
  if (after == times.end() || times[key] == time) return {key, 0, 0};
  const double length = times[key + 1] - times[key];
  return {key, (time - times[key]) / length, length};
}

Vec3 scaled(const Vec3& v, double s) {
  return v * s;
}
Vec4 scaled(const Vec4& v, double s) {
  return v * s;
}
std::vector<double> scaled(std::vector<double> v, double s) {
  for (double& x : v) x *= s;
  return v;
}
std::vector<double> operator+(std::vector<double> a, const std::vector<double>& b) {
  for (std::size_t i = 0; i < a.size() && i < b.size(); ++i) a[i] += b[i];
  return a;
}

// glTF 2.0 appendix C: Hermite spline; tangents are per second, hence the length of the span.
template <class Value>
Value spline(const Value& from, const Value& out_tangent, const Value& in_tangent, const Value& to,
             const KeySpan& span) {
  const double s = span.fraction, s2 = s * s, s3 = s2 * s;
  return scaled(from, 2 * s3 - 3 * s2 + 1) + scaled(out_tangent, span.length * (s3 - 2 * s2 + s)) +
         scaled(to, 3 * s2 - 2 * s3) + scaled(in_tangent, span.length * (s3 - s2));
}

template <class Value>
const Value& key_value(const Track<Value>& track, std::size_t key) {
  return track.values[track.interpolation == Interpolation::CubicSpline ? 3 * key + 1 : key];
}

template <class Value>
Value sample_vector(const Track<Value>& track, double time) {
  SF_EXPECT(!track.is_empty());
  const KeySpan span = find_span(track.times, time);
  const std::size_t k = span.key;
  if (span.length == 0 || track.interpolation == Interpolation::Step) return key_value(track, k);
  if (track.interpolation == Interpolation::CubicSpline)
    return spline(track.values[3 * k + 1], track.values[3 * k + 2], track.values[3 * k + 3],
                  track.values[3 * k + 4], span);
  return scaled(track.values[k], 1 - span.fraction) + scaled(track.values[k + 1], span.fraction);
}

}  // namespace

Vec3 sample(const Vec3Track& track, double time) {
  return sample_vector(track, time);
}

std::vector<double> sample(const WeightsTrack& track, double time) {
  return sample_vector(track, time);
}

Quat sample(const QuatTrack& track, double time) {
  SF_EXPECT(!track.is_empty());
  const KeySpan span = find_span(track.times, time);
  const std::size_t k = span.key;
  if (span.length == 0 || track.interpolation == Interpolation::Step) return key_value(track, k);
  if (track.interpolation == Interpolation::Linear)
    return track.values[k].slerp(span.fraction, track.values[k + 1]);
  const Vec4 sum = spline<Vec4>(track.values[3 * k + 1].coeffs(), track.values[3 * k + 2].coeffs(),
                                track.values[3 * k + 3].coeffs(), track.values[3 * k + 4].coeffs(), span);
  const double norm = sum.norm();
  return norm > 0 ? Quat(Vec4(sum / norm)) : key_value(track, k);
}

Transform sample(const JointTracks& tracks, double time, const Transform& bind) {
  Transform local = bind;
  if (!tracks.translation.is_empty()) local.translation = sample(tracks.translation, time);
  if (!tracks.rotation.is_empty()) local.rotation = sample(tracks.rotation, time);
  if (!tracks.scale.is_empty()) local.scale = sample(tracks.scale, time);
  return local;
}

Pose sample(const Skeleton& skeleton, const Clip& clip, double time) {
  Pose pose = bind_pose(skeleton);
  for (const JointTracks& tracks : clip.joints) {
    Transform& joint = pose[tracks.joint.index()];
    joint = sample(tracks, time, joint);
  }
  return pose;
}

}  // namespace skinforge
