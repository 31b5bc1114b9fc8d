#include "io/build_clips.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/text.h"

namespace skinforge {
namespace {

struct Repairs {
  std::size_t unit_quaternions = 0, late_keys = 0;
};

// Keys whose time does not rise are left out; the first of equal times stays.
template <class Value>
Track<Value> with_rising_times(const Track<Value>& track, Repairs& repairs) {
  const bool rises =
      std::adjacent_find(track.times.begin(), track.times.end(), std::greater_equal<>()) == track.times.end();
  if (rises) return track;
  const std::size_t per_key = track.interpolation == Interpolation::CubicSpline ? 3 : 1;
  Track<Value> kept{track.interpolation, {}, {}};
  for (std::size_t k = 0; k < track.times.size(); ++k) {
    if (!kept.times.empty() && track.times[k] <= kept.times.back()) {
      ++repairs.late_keys;
      continue;
    }
    kept.times.push_back(track.times[k]);
    for (std::size_t i = 0; i < per_key; ++i) kept.values.push_back(track.values[k * per_key + i]);
  }
  return kept;
}

QuatTrack with_unit_values(QuatTrack track, Repairs& repairs) {
  constexpr double kUnit = 1e-5;  // ours: normalised-integer rotations are this far from unit length
  const bool is_cubic = track.interpolation == Interpolation::CubicSpline;
  for (std::size_t i = is_cubic ? 1 : 0; i < track.values.size(); i += is_cubic ? 3 : 1) {
    const double length = track.values[i].norm();
    if (std::abs(length - 1) <= kUnit) continue;
    track.values[i] = length > 0 ? track.values[i].normalized() : Quat::Identity();
    ++repairs.unit_quaternions;
  }
  return track;
}

template <class Value>
void hold(Track<Value>& track, const Value& value) {
  track.times = {0};
  track.values = {value};
  track.interpolation = Interpolation::Linear;
}

// What the file's default pose says where the clip says nothing and the bind pose differs.
void hold_defaults(JointTracks& tracks, const Transform& bind, const Transform& file_default) {
  constexpr double kSame = 1e-7;  // ours: of the value's size, far below what a float can tell
  if (tracks.translation.is_empty() &&
      (bind.translation - file_default.translation).norm() >
          kSame * (bind.translation.norm() + file_default.translation.norm()))
    hold(tracks.translation, file_default.translation);
  if (tracks.rotation.is_empty() && std::abs(bind.rotation.dot(file_default.rotation)) < 1 - kSame * kSame)
    hold(tracks.rotation, file_default.rotation);
  if (tracks.scale.is_empty() &&
      (bind.scale - file_default.scale).norm() > kSame * (bind.scale.norm() + file_default.scale.norm()))
    hold(tracks.scale, file_default.scale);
}

// The root's keys in metres: values by the whole map, tangents by its linear part.
void premultiply(JointTracks& tracks, const Similarity& s) {
  if (s.is_identity()) return;
  const auto is_tangent = [](Interpolation i, std::size_t k) {
    return i == Interpolation::CubicSpline && k % 3 != 1;
  };
  for (std::size_t k = 0; k < tracks.translation.values.size(); ++k) {
    Vec3& v = tracks.translation.values[k];
    v = s.scale * (s.rotation * v) +
        (is_tangent(tracks.translation.interpolation, k) ? Vec3(Vec3::Zero()) : s.translation);
  }
  for (Quat& q : tracks.rotation.values) q = s.rotation * q;
  for (Vec3& v : tracks.scale.values) v *= s.scale;
}

double last_time(const JointTracks& t) {
  double last = 0;
  for (const auto* times : {&t.translation.times, &t.rotation.times, &t.scale.times})
    if (!times->empty()) last = std::max(last, times->back());
  return last;
}

Clip build_clip(const RawScene::Animation& animation, const RawScene& scene, const SceneJoints& joints,
                const std::vector<PartId>& part_of_node, Repairs& repairs) {
  Clip clip;
  std::map<JointId, JointTracks> tracks;
  for (const RawScene::NodeTracks& node : animation.nodes) {
    const JointId joint = joints.joint_of_node[node.node];
    if (joint.is_valid()) {
      JointTracks& t = tracks[joint];
      if (!node.translation.is_empty()) t.translation = with_rising_times(node.translation, repairs);
      if (!node.rotation.is_empty())
        t.rotation = with_unit_values(with_rising_times(node.rotation, repairs), repairs);
      if (!node.scale.is_empty()) t.scale = with_rising_times(node.scale, repairs);
    }
    const PartId part = part_of_node[node.node];
    if (!node.morph_weights.is_empty() && part.is_valid()) {
      clip.morphs.push_back({part, with_rising_times(node.morph_weights, repairs)});
      clip.duration = std::max(clip.duration, clip.morphs.back().weights.times.back());
    }
  }
  if (!joints.root_is_made && tracks.contains(JointId(0)))
    premultiply(tracks[JointId(0)], scene.metres_from_file);
  for (std::size_t j = 0; j < joints.skeleton.size(); ++j)
    hold_defaults(tracks[JointId(j)], joints.skeleton.joints[j].bind, joints.default_pose[j]);
  for (auto& [joint, t] : tracks) {
    if (t.translation.is_empty() && t.rotation.is_empty() && t.scale.is_empty()) continue;
    t.joint = joint;
    clip.duration = std::max(clip.duration, last_time(t));
    clip.joints.push_back(std::move(t));
  }
  return clip;
}

}  // namespace

std::vector<Clip> build_clips(const RawScene& scene, const SceneJoints& joints,
                              const std::vector<PartId>& part_of_node, const std::string& place,
                              IssueSink& issues) {
  std::vector<Clip> clips;
  std::set<std::string> taken;
  Repairs repairs;
  int renamed = 0;
  for (std::size_t a = 0; a < scene.animations.size(); ++a) {
    Clip clip = build_clip(scene.animations[a], scene, joints, part_of_node, repairs);
    const std::string wanted = scene.animations[a].name;
    const std::string base = wanted.empty() ? fmt::format("clip{}", a) : printable(wanted);
    clip.name = base;
    for (int n = 2; !taken.insert(clip.name).second; ++n) clip.name = fmt::format("{}_{}", base, n);
    renamed += clip.name != wanted;
    clips.push_back(std::move(clip));
  }
  if (renamed > 0)
    issues.note("clips-renamed", place, fmt::format("{} clips had no name or one that was taken", renamed));
  if (repairs.unit_quaternions > 0)
    issues.warn("rotations-normalised", place,
                fmt::format("{} rotation keys were not of unit length", repairs.unit_quaternions));
  if (repairs.late_keys > 0)
    issues.warn(
        "keys-out-of-order", place,
        fmt::format("{} keys did not come after the one before and were left out", repairs.late_keys));
  return clips;
}

}  // namespace skinforge
