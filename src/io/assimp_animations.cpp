#include "io/assimp_animations.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/text.h"
#include "io/assimp_values.h"

namespace skinforge {
namespace {

constexpr double kDefaultTicksPerSecond = 25;  // what Assimp documents for files that do not say

/// The nodes by name; of two with one name the first, as Assimp's channels mean it.
std::map<std::string, std::int32_t> nodes_by_name(const NodeIndex& index) {
  std::map<std::string, std::int32_t> names;
  for (const auto& [node, target] : index) {
    const auto [entry, is_new] = names.try_emplace(to_text(node->mName), target);
    if (!is_new) entry->second = std::min(entry->second, target);
  }
  return names;
}

Vec3Track read_track(const aiVectorKey* keys, unsigned count, double ticks_per_second) {
  Vec3Track track;
  for (unsigned k = 0; k < count; ++k) {
    track.times.push_back(keys[k].mTime / ticks_per_second);
    track.values.push_back(to_vec3(keys[k].mValue));
  }
  return track;
}

QuatTrack read_track(const aiQuatKey* keys, unsigned count, double ticks_per_second) {
  QuatTrack track;
  for (unsigned k = 0; k < count; ++k) {
    track.times.push_back(keys[k].mTime / ticks_per_second);
    track.values.push_back(to_quat(keys[k].mValue));
  }
  return track;
}

WeightsTrack read_track(const aiMeshMorphAnim& channel, std::size_t targets, double ticks_per_second) {
  WeightsTrack track;
  for (unsigned k = 0; k < channel.mNumKeys; ++k) {
    const aiMeshMorphKey& key = channel.mKeys[k];
    track.times.push_back(key.mTime / ticks_per_second);
    track.values.emplace_back(targets, 0.0);
    for (unsigned i = 0; i < key.mNumValuesAndWeights; ++i)
      if (key.mValues[i] < targets) track.values.back()[key.mValues[i]] = key.mWeights[i];
  }
  return track;
}

class AnimationReader {
 public:
  AnimationReader(const NodeIndex& index, RawScene& scene) : names_(nodes_by_name(index)), scene_(scene) {}

  RawScene::Animation read(const aiAnimation& source) {
    RawScene::Animation animation;
    animation.name = to_text(source.mName);
    places_.clear();
    const double rate = source.mTicksPerSecond > 0 ? source.mTicksPerSecond : kDefaultTicksPerSecond;
    for (unsigned c = 0; c < source.mNumChannels; ++c) {
      const aiNodeAnim& channel = *source.mChannels[c];
      RawScene::NodeTracks* tracks = tracks_of(animation, to_text(channel.mNodeName));
      if (!tracks) continue;
      tracks->translation = read_track(channel.mPositionKeys, channel.mNumPositionKeys, rate);
      tracks->rotation = read_track(channel.mRotationKeys, channel.mNumRotationKeys, rate);
      tracks->scale = read_track(channel.mScalingKeys, channel.mNumScalingKeys, rate);
    }
    for (unsigned c = 0; c < source.mNumMorphMeshChannels; ++c)
      add_morph(animation, *source.mMorphMeshChannels[c], rate);
    return animation;
  }

 private:
  RawScene::NodeTracks* tracks_of(RawScene::Animation& animation, const std::string& name) {
    const auto node = names_.find(name);
    if (node == names_.end()) {
      scene_.issues.push_back({"channel-without-node", Severity::Warning, "clip " + printable(animation.name),
                               fmt::format("no node \"{}\" for a channel", printable(name))});
      return nullptr;
    }
    const auto [place, is_new] = places_.try_emplace(node->second, animation.nodes.size());
    if (is_new) animation.nodes.emplace_back().node = node->second;
    return &animation.nodes[place->second];
  }

  /// A morph channel is called "NODE*INDEX".
  void add_morph(RawScene::Animation& animation, const aiMeshMorphAnim& channel, double rate) {
    const std::string name = to_text(channel.mName);
    RawScene::NodeTracks* tracks = tracks_of(animation, name.substr(0, name.rfind('*')));
    if (!tracks) return;
    const std::int32_t mesh = scene_.nodes[static_cast<std::size_t>(tracks->node)].mesh;
    if (mesh < 0) return;
    const std::size_t targets = scene_.meshes[static_cast<std::size_t>(mesh)].morph_names.size();
    if (targets > 0) tracks->morph_weights = read_track(channel, targets, rate);
  }

  std::map<std::string, std::int32_t> names_;
  std::map<std::int32_t, std::size_t> places_;  ///< of a node's tracks in the animation at hand
  RawScene& scene_;
};

}  // namespace

void read_animations(const aiScene& source, const NodeIndex& index, RawScene& scene) {
  AnimationReader reader(index, scene);
  for (unsigned a = 0; a < source.mNumAnimations; ++a)
    scene.animations.push_back(reader.read(*source.mAnimations[a]));
}

}  // namespace skinforge
