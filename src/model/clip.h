#pragma once

#include <string>
#include <vector>

#include "base/id.h"
#include "base/math.h"

namespace skinforge {

enum class Interpolation : std::uint8_t { Linear, Step, CubicSpline };

/// Keys of one property. `times` in seconds, finite, strictly rising, at least one when the track is not
/// empty. One value per key; CubicSpline has three per key: in-tangent, value, out-tangent (glTF 2.0,
/// appendix C). Before the first and after the last key the nearest key holds.
template <class Value>
struct Track {
  Interpolation interpolation = Interpolation::Linear;
  std::vector<double> times;
  std::vector<Value> values;

  bool is_empty() const { return times.empty(); }

  template <class Archive>
  friend void fields(Archive& a, Track& t) {
    a(t.interpolation, t.times, t.values);
  }
};

using Vec3Track = Track<Vec3>;
using QuatTrack = Track<Quat>;  ///< unit quaternions; Linear means shortest-arc slerp
using WeightsTrack = Track<std::vector<double>>;

/// What a clip does to one joint. An empty track leaves that property at the joint's bind value.
struct JointTracks {
  JointId joint;
  Vec3Track translation;
  QuatTrack rotation;
  Vec3Track scale;

  template <class Archive>
  friend void fields(Archive& a, JointTracks& t) {
    a(t.joint, t.translation, t.rotation, t.scale);
  }
};

/// Morph weights of one part, in the order of that part's morph targets.
struct MorphTracks {
  PartId part;
  WeightsTrack weights;

  template <class Archive>
  friend void fields(Archive& a, MorphTracks& t) {
    a(t.part, t.weights);
  }
};

/// A named animation. `joints` sorted by joint, each at most once; `duration` is the last key's time, in
/// seconds.
struct Clip {
  std::string name;  ///< unique in its character, never empty
  double duration = 0;
  std::vector<JointTracks> joints;
  std::vector<MorphTracks> morphs;

  template <class Archive>
  friend void fields(Archive& a, Clip& c) {
    a(c.name, c.duration, c.joints, c.morphs);
  }
};

}  // namespace skinforge
