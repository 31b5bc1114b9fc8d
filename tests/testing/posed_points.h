#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "model/character.h"

namespace skinforge::testing {

/// A plain player of characters for tests: where every vertex is when a clip plays. Shares no code with
/// src/animation and src/skinning. Morph targets, then linear blend skinning; glTF 2.0 interpolation.
class CharacterPlayer {
 public:
  explicit CharacterPlayer(const Character& character) : character_(character) {}

  std::vector<Vec3> pose(const Clip& clip, double time) const {
    std::vector<Transform> local;
    for (const Joint& joint : character_.skeleton.joints) local.push_back(joint.bind);
    for (const JointTracks& tracks : clip.joints) {
      Transform& t = local[tracks.joint.index()];
      if (!tracks.translation.is_empty()) t.translation = at(tracks.translation, time);
      if (!tracks.scale.is_empty()) t.scale = at(tracks.scale, time);
      if (!tracks.rotation.is_empty()) t.rotation = at(tracks.rotation, time).normalized();
    }
    return skinned(morphed(clip, time), local);
  }

  /// The bind pose by its joints, morph targets at their defaults.
  std::vector<Vec3> bind_pose() const {
    std::vector<Transform> local;
    for (const Joint& joint : character_.skeleton.joints) local.push_back(joint.bind);
    return skinned(morphed({}, 0), local);
  }

 private:
  static Eigen::Vector4d coefficients(const Quat& q) { return q.coeffs(); }
  static Vec3 coefficients(const Vec3& v) { return v; }
  static Eigen::VectorXd coefficients(const std::vector<double>& v) {
    return Eigen::Map<const Eigen::VectorXd>(v.data(), static_cast<Eigen::Index>(v.size()));
  }
  template <class Vector>
  static void assign(Quat& q, const Vector& v) {
    q.coeffs() = v;
  }
  template <class Vector>
  static void assign(Vec3& value, const Vector& v) {
    value = v;
  }
  template <class Vector>
  static void assign(std::vector<double>& value, const Vector& v) {
    value.assign(v.data(), v.data() + v.size());
  }
  static Quat between(const Quat& a, const Quat& b, double t) {
    return a.normalized().slerp(t, b.normalized());
  }
  template <class Value>
  static Value between(const Value& a, const Value& b, double t) {
    Value result = a;
    assign(result, (coefficients(a) * (1 - t) + coefficients(b) * t).eval());
    return result;
  }

  template <class Value>
  static Value at(const Track<Value>& track, double time) {
    const std::size_t per_key = track.interpolation == Interpolation::CubicSpline ? 3 : 1;
    const auto value = [&](std::size_t key, std::size_t slot) { return track.values[per_key * key + slot]; };
    const auto next = static_cast<std::size_t>(
        std::upper_bound(track.times.begin(), track.times.end(), time) - track.times.begin());
    if (next == 0) return value(0, per_key / 2);
    if (next == track.times.size() || track.interpolation == Interpolation::Step)
      return value(next - 1, per_key / 2);
    const double step = track.times[next] - track.times[next - 1], t = (time - track.times[next - 1]) / step;
    if (per_key == 1) return between(value(next - 1, 0), value(next, 0), t);
    Value result = value(next, 1);  // Hermite, glTF 2.0 appendix C
    const double t2 = t * t, t3 = t2 * t;
    assign(result, (coefficients(value(next - 1, 1)) * (2 * t3 - 3 * t2 + 1) +
                    coefficients(value(next - 1, 2)) * (step * (t3 - 2 * t2 + t)) +
                    coefficients(value(next, 1)) * (3 * t2 - 2 * t3) +
                    coefficients(value(next, 0)) * (step * (t3 - t2)))
                       .eval());
    return result;
  }

  std::vector<Vec3> morphed(const Clip& clip, double time) const {
    std::vector<Vec3> points = character_.mesh.positions;
    std::size_t in_part = 0;
    for (std::size_t i = 0; i < character_.morphs.size(); ++i) {
      const MorphTarget& target = character_.morphs[i];
      in_part = i > 0 && character_.morphs[i - 1].part == target.part ? in_part + 1 : 0;
      double weight = target.default_weight;
      for (const MorphTracks& tracks : clip.morphs)
        if (tracks.part == target.part) weight = at(tracks.weights, time)[in_part];
      for (std::size_t k = 0; k < target.vertices.size(); ++k)
        points[target.vertices[k].index()] += weight * target.offsets[k];
    }
    return points;
  }

  std::vector<Vec3> skinned(const std::vector<Vec3>& rest, const std::vector<Transform>& local) const {
    std::vector<Affine3> world;
    for (std::size_t j = 0; j < local.size(); ++j) {
      const JointId parent = character_.skeleton.joints[j].parent;
      world.push_back(parent.is_valid() ? world[parent.index()] * local[j].matrix() : local[j].matrix());
    }
    std::vector<Vec3> points(rest.size(), Vec3::Zero());
    for (std::size_t v = 0; v < rest.size(); ++v)
      for (const Influence& i : character_.weights.of(VertexId(v)))
        points[v] +=
            i.weight * (world[i.joint.index()] * (character_.skeleton[i.joint].joint_from_model * rest[v]));
    return points;
  }

  const Character& character_;
};

/// The largest distance from a point of `from` to the nearest point of `to`. Sorted along x, then scanned:
/// fast when the sets lie on each other.
inline double directed_distance(const std::vector<Vec3>& from, std::vector<Vec3> to) {
  std::sort(to.begin(), to.end(), [](const Vec3& a, const Vec3& b) { return a.x() < b.x(); });
  double worst = 0;
  for (const Vec3& p : from) {
    double best = std::numeric_limits<double>::infinity();
    const auto middle =
        std::lower_bound(to.begin(), to.end(), p.x(), [](const Vec3& a, double x) { return a.x() < x; });
    for (auto q = middle; q != to.end() && q->x() - p.x() < best; ++q) best = std::min(best, (*q - p).norm());
    for (auto q = middle; q != to.begin() && p.x() - std::prev(q)->x() < best; --q)
      best = std::min(best, (*std::prev(q) - p).norm());
    worst = std::max(worst, best);
  }
  return worst;
}

/// The larger of both directed distances (Hausdorff distance of two point sets).
inline double set_distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  return std::max(directed_distance(a, b), directed_distance(b, a));
}

}  // namespace skinforge::testing
