#include "io/glb_animations.h"

#include <algorithm>
#include <utility>

namespace skinforge {
namespace {

void append(std::vector<float>& numbers, const Vec3& value) {
  for (const double x : value) numbers.push_back(static_cast<float>(x));
}
void append(std::vector<float>& numbers, const Quat& value) {
  for (const double x : value.coeffs()) numbers.push_back(static_cast<float>(x));  // x, y, z, w as glTF
}
void append(std::vector<float>& numbers, const std::vector<double>& value) {
  for (const double x : value) numbers.push_back(static_cast<float>(x));
}

/// Keys of one track as they are written.
struct FloatKeys {
  std::vector<float> times;
  std::vector<float> values;
  Interpolation interpolation = Interpolation::Linear;
};

template <class Value>
FloatKeys float_keys(const Track<Value>& track, double start) {
  FloatKeys keys;
  keys.interpolation = track.interpolation;
  const std::size_t per_key = track.interpolation == Interpolation::CubicSpline ? 3 : 1;
  for (std::size_t i = 0; i < track.times.size(); ++i) {
    const auto time = static_cast<float>(track.times[i] - start);
    if (!keys.times.empty() && time <= keys.times.back()) continue;
    keys.times.push_back(time);
    for (std::size_t k = 0; k < per_key; ++k) append(keys.values, track.values[i * per_key + k]);
  }
  if (per_key == 3 && keys.times.size() == 1) {  // glTF wants two keys for a spline; one key is a constant
    keys.interpolation = Interpolation::Step;
    const std::size_t width = keys.values.size() / 3;
    keys.values = {keys.values.begin() + static_cast<std::ptrdiff_t>(width),
                   keys.values.begin() + static_cast<std::ptrdiff_t>(2 * width)};
  }
  return keys;
}

/// Times of the first and the last key, 0 among them.
std::pair<double, double> span_of(const Clip& clip) {
  double first = 0, last = 0;
  const auto take = [&](const auto& track) {
    if (track.is_empty()) return;
    first = std::min(first, track.times.front());
    last = std::max(last, track.times.back());
  };
  for (const JointTracks& tracks : clip.joints) {
    take(tracks.translation);
    take(tracks.rotation);
    take(tracks.scale);
  }
  for (const MorphTracks& tracks : clip.morphs) take(tracks.weights);
  return {first, last};
}

const char* name_of(Interpolation interpolation) {
  if (interpolation == Interpolation::Step) return "STEP";
  return interpolation == Interpolation::CubicSpline ? "CUBICSPLINE" : "LINEAR";
}

class ClipWriter {
 public:
  ClipWriter(const Character& character, const std::map<PartId, std::size_t>& morph_nodes, GlbBuffer& buffer,
             JsonText& json)
      : character_(character), morph_nodes_(morph_nodes), buffer_(buffer), json_(json) {}

  void write(const Clip& clip) {
    channels_.clear();
    const auto [start, end] = span_of(clip);
    for (const JointTracks& tracks : clip.joints) {
      add(tracks.joint.index(), "translation", "VEC3", tracks.translation, start);
      add(tracks.joint.index(), "rotation", "VEC4", tracks.rotation, start);
      add(tracks.joint.index(), "scale", "VEC3", tracks.scale, start);
    }
    for (const MorphTracks& tracks : clip.morphs)
      if (const auto node = morph_nodes_.find(tracks.part); node != morph_nodes_.end())
        add(node->second, "weights", "SCALAR", tracks.weights, start);
    constexpr double kRounding = 1e-6;  // ours: seconds
    if (channels_.empty() || end < clip.duration - kRounding) add_hold(clip, start);
    write_object(clip);
  }

 private:
  struct Channel {
    std::size_t node = 0;
    const char* path = "";
    std::size_t input = 0;
    std::size_t output = 0;
    Interpolation interpolation = Interpolation::Linear;
  };

  template <class Value>
  void add(std::size_t node, const char* path, const char* type, const Track<Value>& track, double start) {
    if (track.is_empty()) return;
    const FloatKeys keys = float_keys(track, start);
    const std::size_t input =
        buffer_.add(GlbBuffer::Use::Animation, "SCALAR", std::span<const float>(keys.times), true);
    const std::size_t output =
        buffer_.add(GlbBuffer::Use::Animation, type, std::span<const float>(keys.values));
    channels_.push_back({node, path, input, output, keys.interpolation});
  }

  // A clip without a key at its end would be over before: the first property that it leaves alone is held as
  // it is for as long as the clip lasts.
  void add_hold(const Clip& clip, double start) {
    const auto held = [&](const Vec3& value) {
      if (clip.duration > 0) return Vec3Track{Interpolation::Linear, {0, clip.duration}, {value, value}};
      return Vec3Track{Interpolation::Linear, {0}, {value}};
    };
    for (std::size_t j = 0; j < character_.skeleton.size(); ++j) {
      const auto tracks = std::find_if(clip.joints.begin(), clip.joints.end(),
                                       [&](const JointTracks& t) { return t.joint == JointId(j); });
      const Transform& bind = character_.skeleton.joints[j].bind;
      if (tracks == clip.joints.end() || tracks->translation.is_empty())
        return add(j, "translation", "VEC3", held(bind.translation), start);
      if (tracks->scale.is_empty()) return add(j, "scale", "VEC3", held(bind.scale), start);
    }
  }

  void write_object(const Clip& clip) {
    json_.begin_object();
    json_.member("name", clip.name);
    json_.key("channels");
    json_.begin_array();
    for (std::size_t i = 0; i < channels_.size(); ++i) {
      json_.begin_object();
      json_.member("sampler", i);
      json_.key("target");
      json_.begin_object();
      json_.member("node", channels_[i].node);
      json_.member("path", channels_[i].path);
      json_.end_object();
      json_.end_object();
    }
    json_.end_array();
    json_.key("samplers");
    json_.begin_array();
    for (const Channel& channel : channels_) {
      json_.begin_object();
      json_.member("input", channel.input);
      if (channel.interpolation != Interpolation::Linear)
        json_.member("interpolation", name_of(channel.interpolation));
      json_.member("output", channel.output);
      json_.end_object();
    }
    json_.end_array();
    json_.end_object();
  }

  const Character& character_;
  const std::map<PartId, std::size_t>& morph_nodes_;
  GlbBuffer& buffer_;
  JsonText& json_;
  std::vector<Channel> channels_;
};

}  // namespace

void write_animations(const Character& character, const std::map<PartId, std::size_t>& morph_nodes,
                      GlbBuffer& buffer, JsonText& json) {
  if (character.clips.empty()) return;
  json.key("animations");
  json.begin_array();
  ClipWriter writer(character, morph_nodes, buffer, json);
  for (const Clip& clip : character.clips) writer.write(clip);
  json.end_array();
}

}  // namespace skinforge
