#include <fmt/format.h>

#include <cmath>
#include <set>

#include "base/error.h"
#include "model/character.h"

namespace skinforge {
namespace {

[[noreturn]] void broken(const std::string& sentence) {
  throw Error(ExitCode::BadInput, sentence);
}

void check(bool holds, const char* what) {
  if (!holds) broken(what);
}

template <class IdType>
bool in_range(IdType id, std::size_t count) {
  return id.is_valid() && id.index() < count;
}

void check_mesh(const Character& c) {
  const PolygonMesh& m = c.mesh;
  check(!m.face_begin.empty() && m.face_begin.front() == 0, "mesh: face offsets do not start at 0");
  check(static_cast<std::size_t>(m.face_begin.back()) == m.corner_count(),
        "mesh: face offsets do not end at the corners");
  check(m.face_material.size() == m.face_count() && m.face_part.size() == m.face_count(),
        "mesh: a face without material or part slot");
  check(m.normals.size() == m.corner_count(), "mesh: one normal per corner is needed");
  check(m.colors.empty() || m.colors.size() == m.corner_count(), "mesh: colours do not match the corners");
  for (const auto& set : m.uvs)
    check(set.size() == m.corner_count(), "mesh: a UV set does not match the corners");
  for (std::size_t v = 0; v < m.vertex_count(); ++v)
    if (!m.positions[v].allFinite()) broken(fmt::format("mesh: vertex {} is not finite", v));
  for (std::size_t f = 0; f < m.face_count(); ++f) {
    if (m.face_begin[f + 1] - m.face_begin[f] < 3)
      broken(fmt::format("mesh: face {} has fewer than 3 corners", f));
    if (m.face_material[f].is_valid() && !in_range(m.face_material[f], c.materials.size()))
      broken(fmt::format("mesh: face {} uses material {} of {}", f, m.face_material[f].value,
                         c.materials.size()));
    check(in_range(m.face_part[f], m.parts.size()), "mesh: a face belongs to no part");
  }
  for (const VertexId v : m.corners)
    if (!in_range(v, m.vertex_count()))
      broken(fmt::format("mesh: a corner uses vertex {} of {}", v.value, m.vertex_count()));
}

void check_weights(const Character& c) {
  constexpr double kSum = 1e-9;  // a row is normalised in double; a few roundings
  check(c.weights.vertex_count() == c.mesh.vertex_count(), "weights: one row per vertex is needed");
  for (std::size_t v = 0; v < c.mesh.vertex_count(); ++v) {
    double sum = 0;
    for (const Influence& i : c.weights.of(VertexId(v))) {
      if (!in_range(i.joint, c.skeleton.size()))
        broken(fmt::format("weights: vertex {} uses joint {} of {}", v, i.joint.value, c.skeleton.size()));
      if (!(i.weight > 0)) broken(fmt::format("weights: vertex {} has weight {}", v, i.weight));
      sum += i.weight;
    }
    if (std::abs(sum - 1) > kSum) broken(fmt::format("weights: the row of vertex {} sums to {}", v, sum));
  }
}

bool is_finite(const Transform& t) {
  return t.translation.allFinite() && t.rotation.coeffs().allFinite() && t.scale.allFinite();
}

void check_skeleton(const Skeleton& s) {
  check(!s.joints.empty(), "skeleton: no joints");
  std::set<std::string> names;
  for (std::size_t j = 0; j < s.size(); ++j) {
    const Joint& joint = s.joints[j];
    if (joint.name.empty() || !names.insert(joint.name).second)
      broken(fmt::format("skeleton: name \"{}\" is empty or used twice", joint.name));
    const bool placed = j == 0 ? !joint.parent.is_valid() : in_range(joint.parent, j);
    if (!placed) broken(fmt::format("skeleton: joint \"{}\" does not stand behind its parent", joint.name));
    if (!is_finite(joint.bind) || !joint.joint_from_model.matrix().allFinite())
      broken(fmt::format("skeleton: joint \"{}\" is not finite", joint.name));
  }
}

bool is_finite(const Vec3& v) {
  return v.allFinite();
}
bool is_finite(const Quat& q) {
  return q.coeffs().allFinite();
}
bool is_finite(const std::vector<double>& w) {
  for (const double x : w)
    if (!std::isfinite(x)) return false;
  return true;
}

template <class Value>
void check_track(const Track<Value>& track, const std::string& clip) {
  const std::size_t per_key = track.interpolation == Interpolation::CubicSpline ? 3 : 1;
  if (track.values.size() != per_key * track.times.size())
    broken(fmt::format("clip \"{}\": keys and values do not match", clip));
  for (std::size_t k = 0; k < track.times.size(); ++k) {
    const bool rising = k == 0 || track.times[k] > track.times[k - 1];
    if (!std::isfinite(track.times[k]) || !rising)
      broken(fmt::format("clip \"{}\": key times do not rise", clip));
  }
  for (const Value& value : track.values)
    if (!is_finite(value)) broken(fmt::format("clip \"{}\": a key is not finite", clip));
}

void check_clips(const Character& c) {
  std::set<std::string> names;
  for (const Clip& clip : c.clips) {
    if (clip.name.empty() || !names.insert(clip.name).second)
      broken(fmt::format("clip name \"{}\" is empty or used twice", clip.name));
    JointId last;
    for (const JointTracks& tracks : clip.joints) {
      if (!in_range(tracks.joint, c.skeleton.size()) || tracks.joint <= last)
        broken(fmt::format("clip \"{}\": joints out of order or range", clip.name));
      last = tracks.joint;
      check_track(tracks.translation, clip.name);
      check_track(tracks.rotation, clip.name);
      check_track(tracks.scale, clip.name);
    }
    for (const MorphTracks& tracks : clip.morphs) {
      check(in_range(tracks.part, c.mesh.parts.size()), "clip: morph weights of no part");
      check_track(tracks.weights, clip.name);
    }
  }
}

void check_materials(const Character& c) {
  for (const Material& m : c.materials)
    for (const auto* texture : {&m.base_color_texture, &m.metallic_roughness_texture, &m.normal_texture,
                                &m.occlusion_texture, &m.emissive_texture})
      if (*texture && !in_range((*texture)->image, c.images.size()))
        broken(fmt::format("material \"{}\" uses image {} of {}", m.name, (*texture)->image.value,
                           c.images.size()));
}

void check_morphs(const Character& c) {
  for (const MorphTarget& t : c.morphs) {
    check(in_range(t.part, c.mesh.parts.size()) && t.vertices.size() == t.offsets.size(),
          "morph target: counts do not match");
    for (std::size_t i = 0; i < t.vertices.size(); ++i)
      if (!in_range(t.vertices[i], c.mesh.vertex_count()) || !t.offsets[i].allFinite())
        broken(fmt::format("morph target \"{}\": entry {} is bad", t.name, i));
  }
}

}  // namespace

void validate(const Character& character) {
  check_skeleton(character.skeleton);
  check_mesh(character);
  check_weights(character);
  check_clips(character);
  check_materials(character);
  check_morphs(character);
}

}  // namespace skinforge
