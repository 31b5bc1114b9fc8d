#include <algorithm>
#include <map>
#include <set>

#include "base/expect.h"
#include "io/export.h"
#include "io/glb_animations.h"
#include "io/glb_buffer.h"
#include "io/glb_geometry.h"
#include "io/glb_json.h"
#include "io/glb_materials.h"
#include "io/gltf_json.h"
#include "io/written_weights.h"

namespace skinforge {
namespace {

using Use = GlbBuffer::Use;

constexpr const char* kPolygons = "FB_ngon_encoding";

/// The joints and weights of a primitive, in groups of four.
struct WeightSet {
  std::vector<std::uint16_t> joints;
  std::vector<float> weights;
};

class GlbWriter {
 public:
  GlbWriter(const Character& character, const GlbOptions& options)
      : character_(character), options_(options) {}

  Bytes write() {
    meshes_ = glb_meshes(character_);
    JsonText body;
    write_scene(body);
    write_nodes(body);
    write_meshes(body);
    write_skin(body);
    write_animations(character_, morph_nodes(), buffer_, body);
    extensions_ = write_materials(character_, buffer_, body);
    if (options_.encode_polygons && !meshes_.empty()) extensions_.insert(kPolygons);
    buffer_.close();
    buffer_.write(body);
    return container(header() + body.take() + "}");
  }

 private:
  std::size_t joint_count() const { return character_.skeleton.size(); }
  /// Joint j is node j; the nodes of the meshes follow.
  std::size_t mesh_node(std::size_t mesh) const { return joint_count() + mesh; }

  std::map<PartId, std::size_t> morph_nodes() const {
    std::map<PartId, std::size_t> nodes;
    for (std::size_t i = 0; i < meshes_.size(); ++i)
      if (meshes_[i].morph_part.is_valid()) nodes[meshes_[i].morph_part] = mesh_node(i);
    return nodes;
  }

  /// What stands before the other members: it names extensions that are known only at the end. Ends with a
  /// comma.
  std::string header() const {
    JsonText json;
    json.begin_object();
    json.key("asset");
    json.begin_object();
    json.member("version", "2.0");
    json.member("generator", "SkinForge");
    if (!options_.extras_json.empty()) {
      json.key("extras");
      json.begin_object();
      json.key("skinforge");
      json.raw(options_.extras_json);
      json.end_object();
    }
    json.end_object();
    if (!extensions_.empty()) {
      json.key("extensionsUsed");
      json.begin_array();
      for (const std::string& name : extensions_) json.text(name);
      json.end_array();
    }
    return json.take() + ",";
  }

  void write_scene(JsonText& json) const {
    json.member("scene", std::size_t{0});
    json.key("scenes");
    json.begin_array();
    json.begin_object();
    std::vector<std::size_t> roots = {0};
    for (std::size_t i = 0; i < meshes_.size(); ++i) roots.push_back(mesh_node(i));
    json.member("nodes", roots);
    json.end_object();
    json.end_array();
  }

  void write_nodes(JsonText& json) const {
    const auto children = character_.skeleton.children();
    std::set<std::string> joint_names;
    json.key("nodes");
    json.begin_array();
    for (std::size_t j = 0; j < joint_count(); ++j) {
      write_joint(character_.skeleton.joints[j], children[j], json);
      joint_names.insert(character_.skeleton.joints[j].name);
    }
    for (std::size_t i = 0; i < meshes_.size(); ++i) {
      // Readers that look nodes up by name must not find a mesh for a joint.
      std::string name = meshes_[i].name;
      while (joint_names.contains(name)) name += "_mesh";
      json.begin_object();
      json.member("name", name);
      json.member("mesh", i);
      json.member("skin", std::size_t{0});
      json.end_object();
    }
    json.end_array();
  }

  static void write_joint(const Joint& joint, const std::vector<JointId>& children, JsonText& json) {
    json.begin_object();
    json.member("name", joint.name);
    std::vector<std::size_t> indices;
    for (const JointId child : children) indices.push_back(child.index());
    if (!indices.empty()) json.member("children", indices);
    const Transform& t = joint.bind;
    if (!t.translation.isZero(0))
      json.member("translation", std::span<const double>(t.translation.data(), 3));
    if (t.rotation.coeffs() != Quat::Identity().coeffs())
      json.member("rotation", std::span<const double>(t.rotation.coeffs().data(), 4));
    if (t.scale != Vec3::Ones()) json.member("scale", std::span<const double>(t.scale.data(), 3));
    json.end_object();
  }

  void write_meshes(JsonText& json) {
    if (meshes_.empty()) return;
    json.key("meshes");
    json.begin_array();
    for (const GlbMesh& mesh : meshes_) {
      const std::vector<const MorphTarget*> targets = targets_of(mesh.morph_part);
      json.begin_object();
      json.member("name", mesh.name);
      json.key("primitives");
      json.begin_array();
      for (const GlbPrimitive& primitive : mesh.primitives) write_primitive(primitive, targets, json);
      json.end_array();
      if (!targets.empty()) write_morph_defaults(targets, json);
      json.end_object();
    }
    json.end_array();
  }

  std::vector<const MorphTarget*> targets_of(PartId part) const {
    std::vector<const MorphTarget*> targets;
    for (const MorphTarget& target : character_.morphs)
      if (part.is_valid() && target.part == part) targets.push_back(&target);
    return targets;
  }

  static void write_morph_defaults(const std::vector<const MorphTarget*>& targets, JsonText& json) {
    std::vector<double> weights;
    for (const MorphTarget* target : targets) weights.push_back(target->default_weight);
    json.member("weights", weights);
    json.key("extras");
    json.begin_object();
    json.key("targetNames");  // not part of glTF, but what exporters and engines agree on
    json.begin_array();
    for (const MorphTarget* target : targets) json.text(target->name);
    json.end_array();
    json.end_object();
  }

  void write_primitive(const GlbPrimitive& primitive, const std::vector<const MorphTarget*>& targets,
                       JsonText& json) {
    json.begin_object();
    json.key("attributes");
    json.begin_object();
    write_attributes(primitive, json);
    json.end_object();
    json.member("indices", add_indices(primitive));
    if (primitive.material.is_valid()) json.member("material", primitive.material.index());
    if (!targets.empty()) write_targets(primitive, targets, json);
    if (options_.encode_polygons) {
      json.key("extensions");
      json.begin_object();
      json.key(kPolygons);
      json.begin_object();
      json.end_object();
      json.end_object();
    }
    json.end_object();
  }

  std::size_t add_floats(const char* type, const std::vector<float>& numbers, bool bounds = false) {
    return buffer_.add(Use::Vertices, type, std::span<const float>(numbers), bounds);
  }

  void write_attributes(const GlbPrimitive& primitive, JsonText& json) {
    json.member("POSITION", add_floats("VEC3", primitive.positions, true));
    json.member("NORMAL", add_floats("VEC3", primitive.normals));
    if (!primitive.tangents.empty()) json.member("TANGENT", add_floats("VEC4", primitive.tangents));
    for (std::size_t set = 0; set < primitive.uvs.size(); ++set)
      json.member("TEXCOORD_" + std::to_string(set), add_floats("VEC2", primitive.uvs[set]));
    if (!primitive.colors.empty()) json.member("COLOR_0", add_floats("VEC4", primitive.colors));
    const std::vector<WeightSet> sets = weight_sets(primitive);
    for (std::size_t s = 0; s < sets.size(); ++s) {
      json.member("JOINTS_" + std::to_string(s), add_joints(sets[s].joints));
      json.member("WEIGHTS_" + std::to_string(s), add_floats("VEC4", sets[s].weights));
    }
  }

  std::vector<WeightSet> weight_sets(const GlbPrimitive& primitive) const {
    std::vector<std::vector<Influence>> rows;
    std::size_t longest = 1;
    for (const VertexId v : primitive.vertex) {
      rows.push_back(written_row(character_.weights.of(v), options_.max_influences));
      longest = std::max(longest, rows.back().size());
    }
    std::vector<WeightSet> sets((longest + 3) / 4);
    for (const auto& row : rows)
      for (std::size_t k = 0; k < 4 * sets.size(); ++k) {
        const Influence influence = k < row.size() ? row[k] : Influence{JointId(0), 0};
        sets[k / 4].joints.push_back(static_cast<std::uint16_t>(influence.joint.value));
        sets[k / 4].weights.push_back(static_cast<float>(influence.weight));
      }
    return sets;
  }

  std::size_t add_joints(const std::vector<std::uint16_t>& joints) {
    if (joint_count() > 256)
      return buffer_.add(Use::Vertices, "VEC4", std::span<const std::uint16_t>(joints));
    const std::vector<std::uint8_t> bytes(joints.begin(), joints.end());
    return buffer_.add(Use::Vertices, "VEC4", std::span<const std::uint8_t>(bytes));
  }

  /// The largest value of an index type is reserved, so 65535 vertices fit 16 bits.
  std::size_t add_indices(const GlbPrimitive& primitive) {
    if (primitive.vertex_count() > 65'535)
      return buffer_.add(Use::Indices, "SCALAR", std::span<const std::uint32_t>(primitive.indices));
    const std::vector<std::uint16_t> narrow(primitive.indices.begin(), primitive.indices.end());
    return buffer_.add(Use::Indices, "SCALAR", std::span<const std::uint16_t>(narrow));
  }

  void write_targets(const GlbPrimitive& primitive, const std::vector<const MorphTarget*>& targets,
                     JsonText& json) {
    json.key("targets");
    json.begin_array();
    for (const MorphTarget* target : targets) {
      json.begin_object();
      json.member("POSITION", add_floats("VEC3", offsets(primitive, *target), true));
      json.end_object();
    }
    json.end_array();
  }

  static std::vector<float> offsets(const GlbPrimitive& primitive, const MorphTarget& target) {
    std::vector<float> numbers(3 * primitive.vertex_count(), 0.0F);
    for (std::size_t v = 0; v < primitive.vertex_count(); ++v) {
      const auto found =
          std::lower_bound(target.vertices.begin(), target.vertices.end(), primitive.vertex[v]);
      if (found == target.vertices.end() || *found != primitive.vertex[v]) continue;
      const Vec3& offset = target.offsets[static_cast<std::size_t>(found - target.vertices.begin())];
      for (int c = 0; c < 3; ++c)
        numbers[3 * v + static_cast<std::size_t>(c)] = static_cast<float>(offset[c]);
    }
    return numbers;
  }

  void write_skin(JsonText& json) {
    std::vector<std::size_t> joints;
    std::vector<float> matrices;
    for (std::size_t j = 0; j < joint_count(); ++j) {
      joints.push_back(j);
      Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
      matrix.topRows<3>() = character_.skeleton.joints[j].joint_from_model.matrix();
      for (const double x : matrix.reshaped()) matrices.push_back(static_cast<float>(x));
    }
    json.key("skins");
    json.begin_array();
    json.begin_object();
    json.member("inverseBindMatrices", buffer_.add(Use::Other, "MAT4", std::span<const float>(matrices)));
    json.member("joints", joints);
    json.member("skeleton", std::size_t{0});
    json.end_object();
    json.end_array();
  }

  Bytes container(std::string json) const {
    json.resize((json.size() + 3) / 4 * 4, ' ');
    Bytes file;
    const auto word = [&](std::size_t value) {
      for (int shift = 0; shift < 32; shift += 8)
        file.push_back(static_cast<std::byte>(value >> shift & 0xFF));
    };
    const auto chunk = [&](std::size_t type, std::span<const std::byte> data) {
      word(data.size());
      word(type);
      file.insert(file.end(), data.begin(), data.end());
    };
    word(0x46546C67);  // "glTF"
    word(2);
    word(12 + 8 + json.size() + 8 + buffer_.bytes().size());
    chunk(0x4E4F534A, std::as_bytes(std::span(json)));
    chunk(0x004E4942, buffer_.bytes());
    return file;
  }

  const Character& character_;
  const GlbOptions& options_;
  std::vector<GlbMesh> meshes_;
  GlbBuffer buffer_;
  std::set<std::string> extensions_;
};

}  // namespace

Bytes write_glb(const Character& character, const GlbOptions& options) {
  SF_EXPECT(options.max_influences == 4 || options.max_influences == 8);
  SF_EXPECT(character.skeleton.size() <= 65'536);
  SF_EXPECT(options.extras_json.empty() ||
            JsonDocument(std::as_bytes(std::span(options.extras_json))).root().is_object());
  return GlbWriter(character, options).write();
}

}  // namespace skinforge
