#include "io/build_character_clips.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "base/text.h"

namespace skinforge {
namespace {

constexpr double kUnit = 1e-6;  // floats normalised by their writer are nearer to length 1 than this

std::size_t values_per_key(Interpolation interpolation) {
  return interpolation == Interpolation::CubicSpline ? 3 : 1;
}

/// The keys in order of time; of several at one time the last stays. Returns how many went.
template <class Value>
std::size_t sort_keys(Track<Value>& track) {
  const auto& times = track.times;
  const auto falls = [](double a, double b) { return a >= b; };
  if (std::adjacent_find(times.begin(), times.end(), falls) == times.end()) return 0;
  std::vector<std::size_t> order(times.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return times[a] < times[b]; });
  Track<Value> sorted;
  sorted.interpolation = track.interpolation;
  const std::size_t per_key = values_per_key(track.interpolation);
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i + 1 < order.size() && times[order[i + 1]] == times[order[i]]) continue;
    sorted.times.push_back(times[order[i]]);
    for (std::size_t k = 0; k < per_key; ++k) sorted.values.push_back(track.values[per_key * order[i] + k]);
  }
  const std::size_t gone = track.times.size() - sorted.times.size();
  track = std::move(sorted);
  return std::max(gone, std::size_t{1});
}

/// "Armature|Walk" -> "Walk".
std::string short_name(const std::string& name) {
  const auto bar = name.rfind('|');
  return bar == std::string::npos ? name : name.substr(bar + 1);
}

/// Clip names: cleaned of what stands before the last bar where that leaves them unique.
std::vector<std::string> clip_names(const RawScene& scene, const std::string& place, IssueSink& issues) {
  std::map<std::string, int> count;
  for (const auto& animation : scene.animations) ++count[short_name(animation.name)];
  std::set<std::string> used;
  std::vector<std::string> names;
  for (const auto& animation : scene.animations) {
    const std::string cut = short_name(animation.name);
    const bool can_cut = !cut.empty() && count[cut] == 1;
    std::string wanted = printable(can_cut ? cut : animation.name);
    if (wanted.empty()) wanted = "clip";
    std::string name = wanted;
    for (int number = 2; !used.insert(name).second; ++number) name = fmt::format("{}_{}", wanted, number);
    if (name != animation.name)
      issues.note("clip-renamed", place,
                  fmt::format("clip \"{}\" is called \"{}\"", printable(animation.name), name));
    names.push_back(name);
  }
  return names;
}

class ClipBuilder {
 public:
  ClipBuilder(const RawScene& scene, const JointTable& joints, const std::vector<PartId>& part_of_node,
              std::string place, IssueSink& issues)
      : scene_(scene),
        joints_(joints),
        part_of_node_(part_of_node),
        place_(std::move(place)),
        issues_(issues) {}

  Clip build(const RawScene::Animation& animation, const std::string& name) {
    Clip clip;
    clip.name = name;
    std::map<JointId, JointTracks> by_joint;
    for (const RawScene::NodeTracks& raw : animation.nodes) add_node(raw, by_joint, clip);
    for (std::size_t j = 0; j < joints_.skeleton.size(); ++j) hold_rest(JointId(j), by_joint);
    for (auto& [joint, tracks] : by_joint) {
      tracks.joint = joint;
      clip.joints.push_back(std::move(tracks));
    }
    std::sort(clip.morphs.begin(), clip.morphs.end(),
              [](const MorphTracks& a, const MorphTracks& b) { return a.part < b.part; });
    report();
    return clip;
  }

 private:
  void add_node(const RawScene::NodeTracks& raw, std::map<JointId, JointTracks>& by_joint, Clip& clip) {
    RawScene::NodeTracks tracks = raw;
    resorted_ += sort_keys(tracks.translation) + sort_keys(tracks.rotation) + sort_keys(tracks.scale) +
                 sort_keys(tracks.morph_weights);
    for (const auto* times : {&tracks.translation.times, &tracks.rotation.times, &tracks.scale.times,
                              &tracks.morph_weights.times})
      if (!times->empty()) clip.duration = std::max(clip.duration, times->back());
    const auto node = static_cast<std::size_t>(tracks.node);
    add_morphs(tracks, part_of_node_[node], clip);
    const JointId joint = joints_.joint_of_node[node];
    if (tracks.translation.is_empty() && tracks.rotation.is_empty() && tracks.scale.is_empty()) return;
    if (!joint.is_valid()) {
      ++without_effect_;
      return;
    }
    normalise(tracks.rotation);
    if (joints_.is_top[joint.index()]) to_metres(tracks);
    JointTracks& target = by_joint[joint];
    if (target.translation.is_empty()) target.translation = std::move(tracks.translation);
    if (target.rotation.is_empty()) target.rotation = std::move(tracks.rotation);
    if (target.scale.is_empty()) target.scale = std::move(tracks.scale);
  }

  void add_morphs(RawScene::NodeTracks& tracks, PartId part, Clip& clip) {
    if (tracks.morph_weights.is_empty() || !part.is_valid()) return;
    const auto& mesh =
        scene_.meshes[static_cast<std::size_t>(scene_.nodes[static_cast<std::size_t>(tracks.node)].mesh)];
    for (auto& weights : tracks.morph_weights.values) weights.resize(mesh.morph_names.size(), 0);
    clip.morphs.push_back({part, std::move(tracks.morph_weights)});
  }

  void normalise(QuatTrack& track) {
    const std::size_t per_key = values_per_key(track.interpolation), middle = per_key / 2;
    for (std::size_t k = 0; k < track.times.size(); ++k) {
      Quat& q = track.values[per_key * k + middle];
      const double length = q.norm();
      if (std::abs(length - 1) <= kUnit) continue;
      ++normalised_;
      q = length > 0 ? Quat(q.coeffs() / length) : Quat::Identity();
    }
  }

  /// The root of the file is placed by T R S; `metres_from_file` acts on the values, and on tangents by its
  /// linear part.
  void to_metres(RawScene::NodeTracks& tracks) const {
    const Similarity& s = scene_.metres_from_file;
    if (s.is_identity()) return;
    const bool is_spline = tracks.translation.interpolation == Interpolation::CubicSpline;
    for (std::size_t i = 0; i < tracks.translation.values.size(); ++i) {
      Vec3& v = tracks.translation.values[i];
      v = is_spline && i % 3 != 1 ? Vec3(s.scale * (s.rotation * v)) : Vec3(s * v);
    }
    for (Quat& q : tracks.rotation.values) q = s.rotation * q;
    for (Vec3& v : tracks.scale.values) v *= s.scale;
  }

  /// What the clip does not drive stays in the file's default pose, which need not be the bind pose.
  void hold_rest(JointId joint, std::map<JointId, JointTracks>& by_joint) {
    const Transform& rest = joints_.rest[joint.index()];
    const Transform& bind = joints_.skeleton[joint].bind;
    const auto found = by_joint.find(joint);
    JointTracks tracks = found == by_joint.end() ? JointTracks{} : std::move(found->second);
    if (tracks.translation.is_empty() && rest.translation != bind.translation)
      tracks.translation = {Interpolation::Linear, {0}, {rest.translation}};
    if (tracks.rotation.is_empty() && rest.rotation.coeffs() != bind.rotation.coeffs())
      tracks.rotation = {Interpolation::Linear, {0}, {rest.rotation.normalized()}};
    if (tracks.scale.is_empty() && rest.scale != bind.scale)
      tracks.scale = {Interpolation::Linear, {0}, {rest.scale}};
    if (!tracks.translation.is_empty() || !tracks.rotation.is_empty() || !tracks.scale.is_empty())
      by_joint[joint] = std::move(tracks);
  }

  void report() {
    if (resorted_ > 0)
      issues_.warn("keys-sorted", place_,
                   fmt::format("{} keys stood at the time of another or out of order", resorted_));
    if (normalised_ > 0)
      issues_.note("rotations-normalised", place_,
                   fmt::format("{} rotation keys were not unit", normalised_));
    if (without_effect_ > 0)
      issues_.note("tracks-without-effect", place_,
                   fmt::format("{} nodes of skinned meshes are driven, which moves nothing; left out",
                               without_effect_));
  }

  const RawScene& scene_;
  const JointTable& joints_;
  const std::vector<PartId>& part_of_node_;
  std::string place_;
  IssueSink& issues_;
  std::size_t resorted_ = 0, normalised_ = 0, without_effect_ = 0;
};

}  // namespace

std::vector<Clip> build_clips(const RawScene& scene, const JointTable& joints,
                              const std::vector<PartId>& part_of_node, const std::string& place,
                              IssueSink& issues) {
  const std::vector<std::string> names = clip_names(scene, place, issues);
  std::vector<Clip> clips;
  for (std::size_t a = 0; a < scene.animations.size(); ++a) {
    ClipBuilder builder(scene, joints, part_of_node, fmt::format("{} clip {}", place, names[a]), issues);
    clips.push_back(builder.build(scene.animations[a], names[a]));
  }
  return clips;
}

}  // namespace skinforge
