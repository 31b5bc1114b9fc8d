#include "diff/structure_diff.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/hash.h"
#include "diff/topology_diff.h"
#include "geometry/genus.h"
#include "geometry/mesh_measures.h"

namespace skinforge {

std::size_t key_count(const Clip& clip) {
  std::size_t keys = 0;
  for (const JointTracks& t : clip.joints)
    keys += t.translation.times.size() + t.rotation.times.size() + t.scale.times.size();
  for (const MorphTracks& t : clip.morphs) keys += t.weights.times.size();
  return keys;
}

namespace {
std::string parent_name(const Skeleton& skeleton, JointId joint) {
  const JointId parent = skeleton[joint].parent;
  return parent.is_valid() ? "\"" + skeleton[parent].name + "\"" : "none";
}

void compare_joints(const Character& a, const Character& b, const Correspondence& same,
                    std::vector<std::string>& edits) {
  for (std::size_t j = 0; j < a.skeleton.size(); ++j) {
    const std::string& name = a.skeleton.joints[j].name;
    const JointId image = same.joints[j];
    if (!image.is_valid()) {
      edits.push_back(fmt::format("joint \"{}\" is gone", name));
      continue;
    }
    if (b.skeleton[image].name != name)
      edits.push_back(fmt::format("joint \"{}\" is called \"{}\"", name, b.skeleton[image].name));
    const JointId parent = a.skeleton.joints[j].parent, other = b.skeleton[image].parent;
    const JointId wanted = parent.is_valid() ? same.joints[parent.index()] : JointId();
    if (other != wanted)
      edits.push_back(fmt::format("joint \"{}\" has parent {}, it was {}", name,
                                  parent_name(b.skeleton, image), parent_name(a.skeleton, JointId(j))));
  }
  for (const JointId joint : same.joints_only_in(b))
    edits.push_back(fmt::format("joint \"{}\" is new", b.skeleton[joint].name));
}

// Names that one list has and the other has not, each as often as it does.
void compare_names(const char* what, std::vector<std::string> a, std::vector<std::string> b,
                   std::vector<std::string>& edits) {
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  std::vector<std::string> gone, added;
  std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(gone));
  std::set_difference(b.begin(), b.end(), a.begin(), a.end(), std::back_inserter(added));
  for (const std::string& name : gone) edits.push_back(fmt::format("{} \"{}\" is gone", what, name));
  for (const std::string& name : added) edits.push_back(fmt::format("{} \"{}\" is new", what, name));
}

template <class Item>
std::vector<std::string> names_of(const std::vector<Item>& items) {
  std::vector<std::string> names;
  for (const Item& item : items) names.push_back(item.name);
  return names;
}

// Materials of one name, apart from their textures: images are compared by what they hold.
void compare_materials(const Character& a, const Character& b, std::vector<std::string>& edits) {
  compare_names("material", names_of(a.materials), names_of(b.materials), edits);
  for (const Material& of_a : a.materials) {
    const auto of_b = std::find_if(b.materials.begin(), b.materials.end(),
                                   [&](const Material& m) { return m.name == of_a.name; });
    if (of_b == b.materials.end()) continue;
    constexpr double kSameColor = 1e-4;  // ours: a fortieth of an 8-bit step
    const auto differ = [](double x, double y) { return std::abs(x - y) > kSameColor; };
    const bool has_other_color = (of_a.base_color - of_b->base_color).cwiseAbs().maxCoeff() > kSameColor ||
                                 (of_a.emissive - of_b->emissive).cwiseAbs().maxCoeff() > kSameColor;
    const bool has_other_finish = differ(of_a.metallic, of_b->metallic) ||
                                  differ(of_a.roughness, of_b->roughness) || of_a.unlit != of_b->unlit;
    const bool has_other_texture =
        of_a.base_color_texture.has_value() != of_b->base_color_texture.has_value();
    if (has_other_color || has_other_finish || has_other_texture || of_a.alpha_mode != of_b->alpha_mode ||
        of_a.double_sided != of_b->double_sided)
      edits.push_back(fmt::format("material \"{}\" changed", of_a.name));
  }
}

std::vector<std::string> image_digests(const Character& character) {
  std::vector<std::string> digests;
  for (const Image& image : character.images) digests.push_back(sha256(image.bytes).hex().substr(0, 12));
  return digests;
}

std::vector<std::string> attribute_sets(const Character& character) {
  std::set<std::string> sets;
  for (const MeshPart& part : character.mesh.parts) {
    for (int i = 0; i < part.uv_sets; ++i) sets.insert(fmt::format("UV set {}", i));
    if (part.has_normals) sets.insert("normals");
    if (part.has_colors) sets.insert("colours");
  }
  return {sets.begin(), sets.end()};
}
}  // namespace

CharacterCounts count(const Character& character) {
  const MeshTopology topology = measure_topology(character.mesh);
  CharacterCounts counts;
  counts.joints = character.skeleton.size();
  counts.vertices = character.mesh.vertex_count();
  counts.faces = topology.faces;
  counts.quads = topology.quads;
  for (std::size_t f = 0; f < character.mesh.face_count(); ++f)
    counts.triangles += character.mesh.face(FaceId(f)).size() - 2;
  counts.components = topology.components;
  counts.open_edges = topology.boundary_edges;
  counts.non_manifold_edges = topology.non_manifold_edges;
  const SurfaceGenus genus = measure_genus(character.mesh);
  counts.genus = genus.handles;
  counts.boundary_loops = genus.boundary_loops;
  counts.parts = character.mesh.parts.size();
  counts.materials = character.materials.size();
  counts.images = character.images.size();
  counts.morphs = character.morphs.size();
  counts.clips = character.clips.size();
  for (const Clip& clip : character.clips) counts.keys += key_count(clip);
  counts.uv_sets = character.mesh.uvs.size();
  for (std::size_t v = 0; v < character.weights.vertex_count(); ++v)
    counts.influences = std::max(counts.influences, character.weights.of(VertexId(v)).size());
  return counts;
}

StructureDiff compare_structure(const Character& a, const Character& b, const Correspondence& same) {
  StructureDiff diff{count(a), count(b), {}};
  compare_joints(a, b, same, diff.edits);
  compare_names("clip", names_of(a.clips), names_of(b.clips), diff.edits);
  compare_materials(a, b, diff.edits);
  compare_names("image", image_digests(a), image_digests(b), diff.edits);
  compare_names("morph target", names_of(a.morphs), names_of(b.morphs), diff.edits);
  compare_names("attribute", attribute_sets(a), attribute_sets(b), diff.edits);
  for (std::string& edit : compare_topology(a, b, same, diff.a, diff.b))
    diff.edits.push_back(std::move(edit));
  return diff;
}

}  // namespace skinforge
