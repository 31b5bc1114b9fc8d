// Skinned positions from what the reader keeps, against a second reader that shares no code with it.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "io/gltf_reader.h"
#include "testing/assets.h"
#include "testing/gltf_evaluator.h"

namespace skinforge {
namespace {

using Points = std::vector<Vec3>;

/// The two evaluations order their products differently; of the diagonal.
constexpr double kRounding = 1e-11;

/// Plays a raw scene by the formulas of glTF 2.0, sections 3.7 and 3.11 and appendix C.
class ScenePlayer {
 public:
  explicit ScenePlayer(const RawScene& scene) : scene_(scene) {}

  Points pose(const RawScene::Animation& animation, double time) const {
    std::vector<Transform> local = rest();
    std::vector<std::vector<double>> weights = rest_weights();
    for (const RawScene::NodeTracks& t : animation.nodes) {
      Transform& node = local[static_cast<std::size_t>(t.node)];
      node.translation = at(t.translation, time, node.translation);
      node.scale = at(t.scale, time, node.scale);
      node.rotation = at(t.rotation, time, node.rotation).normalized();
      auto& w = weights[static_cast<std::size_t>(t.node)];
      w = at(t.morph_weights, time, w);
    }
    return points(local, weights);
  }
  Points default_pose() const { return points(rest(), rest_weights()); }

 private:
  static Vec3 mix(const Vec3& a, const Vec3& b, double t) { return a + (b - a) * t; }
  static Quat mix(const Quat& a, const Quat& b, double t) { return a.normalized().slerp(t, b.normalized()); }
  static std::vector<double> mix(std::vector<double> a, const std::vector<double>& b, double t) {
    for (std::size_t i = 0; i < a.size(); ++i) a[i] += (b[i] - a[i]) * t;
    return a;
  }

  static Vec3 weigh(const Vec3& v, double w) { return v * w; }
  static Quat weigh(const Quat& q, double w) { return Quat(Eigen::Vector4d(q.coeffs() * w)); }
  static std::vector<double> weigh(std::vector<double> v, double w) {
    for (double& x : v) x *= w;
    return v;
  }
  static Vec3 add(const Vec3& a, const Vec3& b) { return a + b; }
  static Quat add(const Quat& a, const Quat& b) { return Quat(Eigen::Vector4d(a.coeffs() + b.coeffs())); }
  static std::vector<double> add(std::vector<double> a, const std::vector<double>& b) {
    for (std::size_t i = 0; i < a.size(); ++i) a[i] += b[i];
    return a;
  }

  template <class Value>
  static Value at(const Track<Value>& track, double time, const Value& rest) {
    if (track.is_empty()) return rest;
    const auto next = std::upper_bound(track.times.begin(), track.times.end(), time) - track.times.begin();
    const bool is_spline = track.interpolation == Interpolation::CubicSpline;
    const auto value = [&](std::ptrdiff_t key, int slot) {
      return track.values[static_cast<std::size_t>(is_spline ? 3 * key + slot : key)];
    };
    if (next == 0) return value(0, 1);
    const auto last = next == std::ptrdiff_t(track.times.size());
    if (last || track.interpolation == Interpolation::Step) return value(next - 1, 1);
    const double step = track.times[std::size_t(next)] - track.times[std::size_t(next - 1)];
    const double t = (time - track.times[std::size_t(next - 1)]) / step;
    if (!is_spline) return mix(value(next - 1, 0), value(next, 0), t);
    // Hermite basis in Horner form: (1-t)^2 (1+2t), t (1-t)^2, t^2 (3-2t), t^2 (t-1).
    const double s = 1 - t;
    return add(
        add(weigh(value(next - 1, 1), s * s * (1 + 2 * t)), weigh(value(next - 1, 2), step * t * s * s)),
        add(weigh(value(next, 1), t * t * (3 - 2 * t)), weigh(value(next, 0), -step * t * t * s)));
  }

  std::vector<Transform> rest() const {
    std::vector<Transform> local;
    for (const RawScene::Node& node : scene_.nodes) {
      local.push_back(node.local);
      local.back().rotation.normalize();  // as stored it is unit to float rounding only
    }
    return local;
  }
  std::vector<std::vector<double>> rest_weights() const {
    std::vector<std::vector<double>> weights;
    for (const RawScene::Node& node : scene_.nodes)
      weights.push_back(node.mesh < 0 ? std::vector<double>()
                                      : scene_.meshes[std::size_t(node.mesh)].morph_weights);
    return weights;
  }

  Affine3 world(const std::vector<Transform>& local, std::int32_t node) const {
    Affine3 matrix = Affine3::Identity();
    for (; node >= 0; node = scene_.nodes[std::size_t(node)].parent)
      matrix = local[std::size_t(node)].matrix() * matrix;
    return matrix;
  }

  Points points(const std::vector<Transform>& local, const std::vector<std::vector<double>>& weights) const {
    Points all;
    cache_.assign(scene_.nodes.size(), std::nullopt);
    for (std::size_t n = 0; n < scene_.nodes.size(); ++n) {
      const RawScene::Node& node = scene_.nodes[n];
      if (node.mesh < 0) continue;
      for (const RawScene::Primitive& p : scene_.meshes[std::size_t(node.mesh)].primitives)
        for (std::size_t v = 0; v < p.positions.size(); ++v) {
          Vec3 position = p.positions[v];
          for (std::size_t m = 0; m < p.morph_offsets.size(); ++m)
            position += weights[n][m] * p.morph_offsets[m][v];
          all.push_back(p.weight_begin.empty() ? world(local, std::int32_t(n)) * position
                                               : skinned(local, node.skin, p, v, position));
        }
    }
    return all;
  }

  Vec3 skinned(const std::vector<Transform>& local, std::int32_t skin_index, const RawScene::Primitive& p,
               std::size_t v, const Vec3& position) const {
    const RawScene::Skin& skin = scene_.skins[std::size_t(skin_index)];
    const auto placed = [&](std::size_t j) {
      const Affine3 bind = skin.inverse_bind.empty() ? Affine3::Identity() : skin.inverse_bind[j];
      return Vec3(palette(local, skin.joints[j]) * (bind * position));
    };
    Vec3 sum = Vec3::Zero();
    double total = 0;
    for (auto k = std::size_t(p.weight_begin[v]); k < std::size_t(p.weight_begin[v + 1]); ++k)
      if (p.weight_value[k] > 0) {
        sum += p.weight_value[k] * placed(std::size_t(p.weight_joint[k]));
        total += p.weight_value[k];
      }
    return total > 0 ? Vec3(sum / total) : placed(0);
  }

  /// World matrix of a node in the pose that `points` is about.
  const Affine3& palette(const std::vector<Transform>& local, std::int32_t node) const {
    auto& slot = cache_[std::size_t(node)];
    if (!slot) slot = world(local, node);
    return *slot;
  }

  const RawScene& scene_;
  mutable std::vector<std::optional<Affine3>> cache_;
};

double diagonal(const Points& points) {
  Eigen::AlignedBox3d box;
  for (const Vec3& p : points) box.extend(p);
  return box.diagonal().norm();
}

double largest_distance(const Points& a, const Points& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, (a[i] - b[i]).norm());
  return largest;
}

class GltfPose : public ::testing::TestWithParam<const char*> {};

TEST_P(GltfPose, EqualsASecondReader) {
  SKINFORGE_NEEDS_SHARED();
  const std::string path = testing::shared_file("assets/" + std::string(GetParam()));
  const RawScene scene = read_gltf(read_input_files(path));
  const testing::GltfEvaluator other(path);
  const ScenePlayer player(scene);
  const Points rest = other.default_pose();
  ASSERT_EQ(player.default_pose().size(), rest.size());
  const double tolerance = kRounding * diagonal(rest);
  EXPECT_LE(largest_distance(player.default_pose(), rest), tolerance);
  ASSERT_EQ(scene.animations.size(), std::size_t(other.animation_count()));
  // Two times of every animation would take minutes in the second reader; every fifth one is looked at.
  for (int a = 0; a<other.animation_count(); a += other.animation_count()> 20 ? 5 : 1) {
    EXPECT_EQ(scene.animations[std::size_t(a)].name, other.animation_name(a));
    for (const double part : {0.0, 0.37}) {
      const double time = part * other.duration(a);
      EXPECT_LE(largest_distance(player.pose(scene.animations[std::size_t(a)], time), other.pose(a, time)),
                tolerance)
          << scene.animations[std::size_t(a)].name << " at " << time;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Assets, GltfPose,
    ::testing::Values("conf_interpolation/interpolation_test.gltf", "conf_morph_cube/AnimatedMorphCube.gltf",
                      "conf_rigged_simple/rigged_simple.gltf", "conf_simple_skin/simple_skin.gltf",
                      "kaykit_knight/knight.glb", "khronos_cesium_man/cesium_man.gltf", "khronos_fox/fox.glb",
                      "quaternius_dolphin/dolphin.glb", "quaternius_horse/horse.glb",
                      "quaternius_robot_expressive/robot_expressive.glb", "quaternius_trex/trex.glb",
                      "quaternius_woman_adventurer_nan/adventurer_nan.glb"),
    [](const auto& instance) {
      std::string name = instance.param;
      name = name.substr(0, name.find('/'));
      return name;
    });

}  // namespace
}  // namespace skinforge
