#include "io/gltf_animations.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/limits.h"
#include "base/text.h"

namespace skinforge {
namespace {

constexpr double kUnitQuaternion = 5e-3;  // as for nodes: what rounding to 8 bits leaves

/// Keys of one channel as the file has them.
struct Keys {
  Interpolation interpolation = Interpolation::Linear;
  std::vector<double> times;
  GltfValues values;
  std::size_t per_key = 1;  ///< elements a key: 3 for CUBICSPLINE
};

class AnimationReader {
 public:
  AnimationReader(const GltfDocument& document, RawScene& scene, IssueSink& issues)
      : document_(document), scene_(scene), issues_(issues) {}

  void read() {
    for (const JsonPlace& place : document_.root.objects("animations")) {
      RawScene::Animation animation;
      animation.name = place.text_or("name", "");
      const auto samplers = place.required_objects("samplers");
      for (const JsonPlace& channel : place.required_objects("channels"))
        read_channel(channel, samplers, animation);
      scene_.animations.push_back(std::move(animation));
    }
  }

 private:
  void read_channel(const JsonPlace& place, const std::vector<JsonPlace>& samplers,
                    RawScene::Animation& animation) {
    const JsonPlace target = place.get("target");
    const JsonPlace& sampler = samplers[place.get("sampler").index(samplers.size(), "sampler")];
    const std::string path = target.get("path").text();
    if (path != "translation" && path != "rotation" && path != "scale" && path != "weights" &&
        path != "pointer")
      target.get("path").fail(
          fmt::format("\"{}\" is none of translation, rotation, scale, weights", printable(path)));
    if (!target.has("node") || path == "pointer") {
      issues_.note("channel-left-out", document_.at(place), "the channel drives no node");
      return;
    }
    const std::size_t node = target.get("node").index(scene_.nodes.size(), "node");
    if (target_has_matrix(node))
      issues_.warn("matrix-animated", document_.at(place),
                   fmt::format("node {} has a matrix; its TRS form is animated", node));
    RawScene::NodeTracks& tracks = tracks_of(node, animation);
    if (path == "translation") store(vec3_track(place, sampler), tracks.translation, place);
    if (path == "scale") store(vec3_track(place, sampler), tracks.scale, place);
    if (path == "rotation") store(rotation_track(place, sampler), tracks.rotation, place);
    if (path == "weights") store(weights_track(place, sampler, node), tracks.morph_weights, place);
  }

  bool target_has_matrix(std::size_t node) const {
    return document_.root.get("nodes").at(node).has("matrix");
  }

  static RawScene::NodeTracks& tracks_of(std::size_t node, RawScene::Animation& animation) {
    const auto index = static_cast<std::int32_t>(node);
    const auto found = std::find_if(animation.nodes.begin(), animation.nodes.end(),
                                    [&](const RawScene::NodeTracks& t) { return t.node == index; });
    if (found != animation.nodes.end()) return *found;
    return animation.nodes.emplace_back(RawScene::NodeTracks{index, {}, {}, {}, {}});
  }

  template <class Value>
  void store(Track<Value> track, Track<Value>& slot, const JsonPlace& place) {
    if (slot.is_empty())
      slot = std::move(track);
    else
      issues_.warn("channel-duplicate", document_.at(place),
                   "a second channel for the same property is left out");
  }

  static Interpolation interpolation(const JsonPlace& sampler) {
    const std::string name = sampler.text_or("interpolation", "LINEAR");
    if (name == "STEP") return Interpolation::Step;
    if (name == "CUBICSPLINE") return Interpolation::CubicSpline;
    if (name != "LINEAR") sampler.get("interpolation").fail("is none of LINEAR, STEP, CUBICSPLINE");
    return Interpolation::Linear;
  }

  /// Times and values of a sampler whose output has `elements` elements a value (more than 1 for morph
  /// weights).
  Keys read_keys(const JsonPlace& sampler, const GltfAccessor& output, std::size_t elements) {
    Keys keys;
    keys.interpolation = interpolation(sampler);
    keys.per_key = keys.interpolation == Interpolation::CubicSpline ? 3 : 1;
    const JsonPlace input = sampler.get("input");
    const GltfAccessor& times = document_.accessors.find(input, {"SCALAR"}, {gltf::kFloat});
    if (output.count != times.count * keys.per_key * elements)
      sampler.get("output").fail(fmt::format("{} elements for {} key times, wanted {}", output.count,
                                             times.count, times.count * keys.per_key * elements));
    number_count_ += times.count + output.count * output.components;
    if (number_count_ > limits().keys)
      input.fail(fmt::format("{} numbers in keys up to here, {}", number_count_, limit_hint("keys")));
    keys.times = GltfAccessors::values(times).numbers;
    keys.values = GltfAccessors::values(output);
    check_times(input, keys);
    return keys;
  }

  void check_times(const JsonPlace& input, const Keys& keys) {
    const auto& t = keys.times;
    if (t.front() < 0) input.fail(fmt::format("the first key time is {}", t.front()));
    for (std::size_t i = 1; i < t.size(); ++i)
      if (t[i] < t[i - 1]) input.fail(fmt::format("key time {} follows {}", t[i], t[i - 1]));
    if (t.back() > static_cast<double>(limits().clip))
      input.fail(fmt::format("key time {} s, {}", t.back(), limit_hint("clip")));
    if (keys.interpolation == Interpolation::CubicSpline && t.size() < 2)
      issues_.warn("cubic-spline-short", document_.at(input), "CUBICSPLINE needs two keys; there is one");
  }

  /// The track of the keys, `value(k)` giving stored value k. Of keys with one time the last stays.
  template <class Value, class Get>
  Track<Value> track(const JsonPlace& place, const Keys& keys, Get&& value) {
    Track<Value> result;
    result.interpolation = keys.interpolation;
    for (std::size_t i = 0; i < keys.times.size(); ++i) {
      if (i + 1 < keys.times.size() && keys.times[i] == keys.times[i + 1]) continue;
      result.times.push_back(keys.times[i]);
      for (std::size_t k = 0; k < keys.per_key; ++k) result.values.push_back(value(i * keys.per_key + k));
    }
    if (const std::size_t dropped = keys.times.size() - result.times.size(); dropped > 0)
      issues_.warn("key-times-equal", document_.at(place),
                   fmt::format("{} keys had the time of the key behind them and are left out", dropped));
    return result;
  }

  Vec3Track vec3_track(const JsonPlace& place, const JsonPlace& sampler) {
    const GltfAccessor& output = document_.accessors.find(sampler.get("output"), {"VEC3"}, {gltf::kFloat});
    const Keys keys = read_keys(sampler, output, 1);
    return track<Vec3>(place, keys, [&](std::size_t k) { return Vec3(keys.values[k]); });
  }

  QuatTrack rotation_track(const JsonPlace& place, const JsonPlace& sampler) {
    const JsonPlace where = sampler.get("output");
    const GltfAccessor& output = document_.accessors.find(
        where, {"VEC4"},
        {gltf::kFloat, gltf::kByte, gltf::kUnsignedByte, gltf::kShort, gltf::kUnsignedShort});
    const Keys keys = read_keys(sampler, output, 1);
    std::size_t turned = 0;
    auto result = track<Quat>(place, keys, [&](std::size_t k) {
      const double* q = keys.values[k];
      const Quat quaternion = quaternion_xyzw(q[0], q[1], q[2], q[3]);
      const bool is_tangent = keys.per_key == 3 && k % 3 != 1;
      return is_tangent ? quaternion : unit(quaternion, output.is_float(), where, turned);
    });
    if (turned > 0)
      issues_.warn("rotation-normalised", document_.at(place),
                   fmt::format("{} rotation keys were not of unit length", turned));
    return result;
  }

  /// Floats that are unit to rounding stay as they are; integers are as coarse as their type and always
  /// scaled.
  static Quat unit(const Quat& quaternion, bool is_float, const JsonPlace& where, std::size_t& turned) {
    const double length = quaternion.norm();
    if (!(length > 0)) where.fail("a rotation key is 0 0 0 0");
    const bool is_unit = std::abs(length - 1) <= kUnitQuaternion;
    if (is_unit && is_float) return quaternion;
    if (!is_unit && is_float) ++turned;
    return quaternion.normalized();
  }

  WeightsTrack weights_track(const JsonPlace& place, const JsonPlace& sampler, std::size_t node) {
    const std::int32_t mesh = scene_.nodes[node].mesh;
    const std::size_t targets =
        mesh < 0 ? 0 : scene_.meshes[static_cast<std::size_t>(mesh)].morph_weights.size();
    if (targets == 0) {
      issues_.warn("channel-left-out", document_.at(place),
                   fmt::format("node {} has no morph targets to drive", node));
      return {};
    }
    const GltfAccessor& output = document_.accessors.find(
        sampler.get("output"), {"SCALAR"},
        {gltf::kFloat, gltf::kByte, gltf::kUnsignedByte, gltf::kShort, gltf::kUnsignedShort});
    const Keys keys = read_keys(sampler, output, targets);
    return track<std::vector<double>>(place, keys, [&](std::size_t k) {
      const double* begin = keys.values[k * targets];
      return std::vector<double>(begin, begin + targets);
    });
  }

  const GltfDocument& document_;
  RawScene& scene_;
  IssueSink& issues_;
  std::size_t number_count_ = 0;
};

}  // namespace

void read_animations(const GltfDocument& document, RawScene& scene, IssueSink& issues) {
  AnimationReader(document, scene, issues).read();
}

}  // namespace skinforge
