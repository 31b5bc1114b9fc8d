#include "io/raw_scene_check.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/limits.h"

namespace skinforge {
namespace {

[[noreturn]] void fail(const std::string& sentence) {
  throw Error(ExitCode::BadInput, sentence);
}

bool in_range(std::int32_t index, std::size_t count) {
  return index >= 0 && static_cast<std::size_t>(index) < count;
}
bool none_or_in_range(std::int32_t index, std::size_t count) {
  return index == -1 || in_range(index, count);
}

template <class Values>
bool all_finite(const Values& values) {
  return std::all_of(values.begin(), values.end(), [](const auto& v) { return v.allFinite(); });
}
bool all_finite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}
bool all_finite(const std::vector<Quat>& values) {
  return std::all_of(values.begin(), values.end(), [](const Quat& q) { return q.coeffs().allFinite(); });
}
bool all_finite(const std::vector<std::vector<double>>& values) {
  return std::all_of(values.begin(), values.end(), [](const auto& v) { return all_finite(v); });
}
bool is_finite(const Transform& t) {
  return t.translation.allFinite() && t.rotation.coeffs().allFinite() && t.scale.allFinite();
}

/// `begin` rises from 0 to `total`.
bool are_offsets(const std::vector<std::int32_t>& begin, std::size_t total) {
  return !begin.empty() && begin.front() == 0 && static_cast<std::size_t>(begin.back()) == total &&
         std::is_sorted(begin.begin(), begin.end());
}

/// Depth of each node, walking up; a walk longer than the limit is a cycle or too deep.
void check_tree(const RawScene& scene) {
  std::vector<std::size_t> depth(scene.nodes.size(), 0);
  for (std::size_t n = 0; n < scene.nodes.size(); ++n) {
    std::vector<std::size_t> path;
    std::size_t at = n;
    while (depth[at] == 0) {
      path.push_back(at);
      if (path.size() > limits().depth)
        fail(fmt::format("node {}: in a cycle, or too many levels deep, {}", n, limit_hint("depth")));
      const std::int32_t parent = scene.nodes[at].parent;
      if (parent < 0) break;
      at = static_cast<std::size_t>(parent);
    }
    std::size_t level = depth[at];
    for (auto node = path.rbegin(); node != path.rend(); ++node) depth[*node] = ++level;
    if (level > limits().depth)
      fail(fmt::format("node {}: {} levels deep, {}", n, level, limit_hint("depth")));
  }
}

void check_nodes(const RawScene& scene) {
  if (scene.nodes.size() > limits().nodes)
    fail(fmt::format("{} nodes, {}", scene.nodes.size(), limit_hint("nodes")));
  for (std::size_t n = 0; n < scene.nodes.size(); ++n) {
    const RawScene::Node& node = scene.nodes[n];
    if (!none_or_in_range(node.parent, scene.nodes.size())) fail(fmt::format("node {}: no such parent", n));
    if (!none_or_in_range(node.mesh, scene.meshes.size())) fail(fmt::format("node {}: no such mesh", n));
    if (!none_or_in_range(node.skin, scene.skins.size())) fail(fmt::format("node {}: no such skin", n));
    if (!is_finite(node.local) || (node.matrix && !node.matrix->matrix().allFinite()))
      fail(fmt::format("node {}: the transform is not finite", n));
  }
  check_tree(scene);
}

void check_weights(const RawScene::Primitive& p, const std::string& place) {
  if (p.weight_begin.empty()) return;
  if (!are_offsets(p.weight_begin, p.weight_joint.size()) ||
      p.weight_begin.size() != p.positions.size() + 1 || p.weight_joint.size() != p.weight_value.size())
    fail(place + ": weights do not match the vertices");
}

void check_primitive(const RawScene::Primitive& p, const RawScene& scene, std::size_t targets,
                     const std::string& place) {
  const std::size_t count = p.positions.size();
  if (count > limits().vertices)
    fail(fmt::format("{}: {} vertices, {}", place, count, limit_hint("vertices")));
  if (!none_or_in_range(p.material, scene.materials.size())) fail(place + ": no such material");
  const auto fits = [&](std::size_t size) { return size == 0 || size == count; };
  if (!fits(p.normals.size()) || !fits(p.colors.size()) ||
      !std::all_of(p.uvs.begin(), p.uvs.end(), [&](const auto& set) { return set.size() == count; }))
    fail(place + ": attributes do not match the vertices");
  if (p.morph_offsets.size() != targets ||
      !std::all_of(p.morph_offsets.begin(), p.morph_offsets.end(),
                   [&](const auto& offsets) { return offsets.size() == count && all_finite(offsets); }))
    fail(place + ": morph targets do not match the vertices");
  if (!all_finite(p.positions)) fail(place + ": a position is not finite");
  if (!are_offsets(p.face_begin, p.corners.size())) fail(place + ": faces do not match their corners");
  for (const std::int32_t v : p.corners)
    if (!in_range(v, count)) fail(fmt::format("{}: a face uses vertex {} of {}", place, v, count));
  check_weights(p, place);
}

void check_meshes(const RawScene& scene) {
  for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
    const RawScene::Mesh& mesh = scene.meshes[m];
    const std::string place = fmt::format("mesh {}", m);
    if (!all_finite(mesh.morph_weights)) fail(place + ": a morph weight is not finite");
    for (const auto& primitive : mesh.primitives)
      check_primitive(primitive, scene, mesh.morph_names.size(), place);
  }
}

void check_skins(const RawScene& scene) {
  for (std::size_t s = 0; s < scene.skins.size(); ++s) {
    const RawScene::Skin& skin = scene.skins[s];
    if (!skin.inverse_bind.empty() && skin.inverse_bind.size() != skin.joints.size())
      fail(fmt::format("skin {}: {} inverse bind matrices for {} joints", s, skin.inverse_bind.size(),
                       skin.joints.size()));
    for (const std::int32_t joint : skin.joints)
      if (!in_range(joint, scene.nodes.size())) fail(fmt::format("skin {}: no such joint", s));
    for (const Affine3& matrix : skin.inverse_bind) {
      const double volume = matrix.linear().determinant();
      if (!matrix.matrix().allFinite() || !std::isfinite(volume) || volume == 0)
        fail(fmt::format("skin {}: an inverse bind matrix cannot be inverted", s));
    }
  }
}

/// Indices of a skinned node's weights; a weight of 0 may name anything.
void check_skinned_nodes(const RawScene& scene) {
  for (const RawScene::Node& node : scene.nodes) {
    if (node.mesh < 0 || node.skin < 0) continue;
    const std::size_t joints = scene.skins[static_cast<std::size_t>(node.skin)].joints.size();
    for (const auto& p : scene.meshes[static_cast<std::size_t>(node.mesh)].primitives)
      for (std::size_t w = 0; w < p.weight_joint.size(); ++w)
        if (p.weight_value[w] > 0 && !in_range(p.weight_joint[w], joints))
          fail(fmt::format("node \"{}\": a weight names joint {} of {}", node.name, p.weight_joint[w],
                           joints));
  }
}

template <class Value>
void check_track(const Track<Value>& track, const std::string& place) {
  const std::size_t per_key = track.interpolation == Interpolation::CubicSpline ? 3 : 1;
  if (track.values.size() != per_key * track.times.size()) fail(place + ": keys and values do not match");
  if (!all_finite(track.times) || !all_finite(track.values)) fail(place + ": a key is not finite");
  const auto most = static_cast<double>(limits().clip);
  for (const double time : track.times)
    if (std::abs(time) > most) fail(fmt::format("{}: key time {} s, {}", place, time, limit_hint("clip")));
}

void check_animations(const RawScene& scene) {
  for (std::size_t a = 0; a < scene.animations.size(); ++a)
    for (const RawScene::NodeTracks& tracks : scene.animations[a].nodes) {
      const std::string place = fmt::format("animation {}", a);
      if (!in_range(tracks.node, scene.nodes.size())) fail(place + ": no such node");
      check_track(tracks.translation, place);
      check_track(tracks.rotation, place);
      check_track(tracks.scale, place);
      check_track(tracks.morph_weights, place);
    }
}

}  // namespace

void check_raw_scene(const RawScene& scene) {
  check_nodes(scene);
  check_meshes(scene);
  check_skins(scene);
  check_skinned_nodes(scene);
  check_animations(scene);
}

}  // namespace skinforge
