#include "io/gltf_meshes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/limits.h"
#include "base/text.h"

namespace skinforge {
namespace {

constexpr std::size_t kMaxWeightSets = 4;  // 16 influences a vertex
constexpr std::size_t kMaxUvSets = 8;
constexpr std::size_t kTriangles = 4, kStrip = 5, kFan = 6;  // primitive modes

using Primitive = RawScene::Primitive;
using Triangle = std::array<std::int32_t, 3>;

/// Triangles of a list, strip or fan of vertices (glTF 2.0, section 3.7.2.1). A strip uses triangles with
/// equal vertices to jump; those are left out.
std::vector<Triangle> triangles_of(const std::vector<std::int32_t>& v, std::size_t mode) {
  std::vector<Triangle> triangles;
  if (mode == kTriangles)
    for (std::size_t i = 0; i + 2 < v.size(); i += 3) triangles.push_back({v[i], v[i + 1], v[i + 2]});
  if (mode == kStrip)
    for (std::size_t i = 0; i + 2 < v.size(); ++i)
      triangles.push_back({v[i], v[i + 1 + i % 2], v[i + 2 - i % 2]});
  if (mode == kFan)
    for (std::size_t i = 0; i + 2 < v.size(); ++i) triangles.push_back({v[i + 1], v[i + 2], v[0]});
  if (mode != kTriangles)
    std::erase_if(triangles, [](const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
  return triangles;
}

void add_triangles(Primitive& primitive, const std::vector<Triangle>& triangles) {
  for (const Triangle& t : triangles) {
    primitive.corners.insert(primitive.corners.end(), t.begin(), t.end());
    primitive.face_begin.push_back(static_cast<std::int32_t>(primitive.corners.size()));
  }
}

/// FB_ngon_encoding: consecutive triangles that start at one vertex, each going on where the last one ended,
/// are the fan of one polygon.
void add_polygons(Primitive& primitive, const std::vector<Triangle>& triangles) {
  for (std::size_t i = 0; i < triangles.size();) {
    const Triangle& first = triangles[i];
    primitive.corners.insert(primitive.corners.end(), first.begin(), first.end());
    for (++i; i < triangles.size(); ++i) {
      const Triangle& next = triangles[i];
      if (next[0] != first[0] || next[1] != primitive.corners.back()) break;
      primitive.corners.push_back(next[2]);
    }
    primitive.face_begin.push_back(static_cast<std::int32_t>(primitive.corners.size()));
  }
}

std::string numbered(const char* name, std::size_t number) {
  return fmt::format("{}_{}", name, number);
}

class MeshReader {
 public:
  MeshReader(const GltfDocument& document, RawScene& scene, IssueSink& issues)
      : document_(document), scene_(scene), issues_(issues) {}

  void read() {
    const auto places = document_.root.objects("meshes");
    material_count_ = document_.root.objects("materials").size();
    count_joints(places.size());
    for (std::size_t i = 0; i < places.size(); ++i) read_mesh(places[i], joint_limit_[i]);
    take_node_weights();
  }

 private:
  static constexpr std::size_t kNoSkin = std::numeric_limits<std::size_t>::max();

  /// A mesh may be used with several skins; its joint indices must fit the smallest.
  void count_joints(std::size_t mesh_count) {
    joint_limit_.assign(mesh_count, kNoSkin);
    for (const RawScene::Node& node : scene_.nodes) {
      if (node.mesh < 0 || node.skin < 0) continue;
      auto& limit = joint_limit_[static_cast<std::size_t>(node.mesh)];
      limit = std::min(limit, scene_.skins[static_cast<std::size_t>(node.skin)].joints.size());
    }
  }

  void read_mesh(const JsonPlace& place, std::size_t joint_limit) {
    RawScene::Mesh mesh;
    mesh.name = place.text_or("name", "");
    std::optional<std::size_t> target_count;
    for (const JsonPlace& entry : place.required_objects("primitives")) {
      const std::size_t targets = entry.objects("targets").size();
      if (target_count.value_or(targets) != targets)
        entry.fail("the primitives of one mesh have different morph target counts");
      target_count = targets;
      if (auto primitive = read_primitive(entry, joint_limit))
        mesh.primitives.push_back(std::move(*primitive));
    }
    read_morph_names(place, *target_count, mesh);
    scene_.meshes.push_back(std::move(mesh));
  }

  void read_morph_names(const JsonPlace& place, std::size_t count, RawScene::Mesh& mesh) {
    mesh.morph_weights.assign(count, 0);
    if (const auto weights = place.find("weights")) mesh.morph_weights = weights->numbers(count);
    mesh.morph_names.assign(count, "");
    if (!place.has("extras") || count == 0) return;
    const JsonPlace extras = place.get("extras");
    if (!extras.is_object() || !extras.has("targetNames")) return;  // a custom of exporters, not part of glTF
    const JsonPlace names = extras.get("targetNames");
    for (std::size_t i = 0; i < std::min(count, names.size()); ++i) mesh.morph_names[i] = names.at(i).text();
  }

  /// Morph weights of a node replace those of its mesh (glTF 2.0, section 3.7.2.2).
  void take_node_weights() {
    const auto places = document_.root.objects("nodes");
    for (std::size_t i = 0; i < places.size(); ++i) {
      const auto weights = places[i].find("weights");
      if (!weights || scene_.nodes[i].mesh < 0) continue;
      auto& defaults = scene_.meshes[static_cast<std::size_t>(scene_.nodes[i].mesh)].morph_weights;
      defaults = weights->numbers(defaults.size());
    }
  }

  std::optional<Primitive> read_primitive(const JsonPlace& place, std::size_t joint_limit) {
    const std::size_t mode = place.count_or("mode", kTriangles);
    if (mode > kFan) place.get("mode").fail(fmt::format("{} is no primitive mode", mode));
    Primitive primitive;
    if (const auto material = place.find("material"))
      primitive.material = static_cast<std::int32_t>(material->index(material_count_, "material"));
    const JsonPlace attributes = place.get("attributes");
    if (!attributes.has("POSITION")) {
      issues_.warn("primitive-skipped", document_.at(place), "the primitive has no positions");
      return std::nullopt;
    }
    read_positions(attributes.get("POSITION"), primitive);
    check_counts(attributes, primitive.positions.size());
    const auto list = vertex_list(place, primitive.positions.size());
    if (mode < kTriangles) {
      issues_.warn("primitive-skipped", document_.at(place), "points and lines are left out");
      return std::nullopt;
    }
    read_shading(attributes, primitive);
    read_weights(attributes, joint_limit, primitive);
    read_faces(place, mode, list, primitive);
    read_targets(place, primitive);
    return primitive;
  }

  void read_positions(const JsonPlace& place, Primitive& primitive) {
    const GltfAccessor& accessor = document_.accessors.find(place, {"VEC3"}, kAnyType);
    count_vertices(place, accessor.count);
    primitive.positions = vectors<Vec3>(accessor);
  }

  void count_vertices(const JsonPlace& place, std::size_t more) {
    vertex_count_ += more;
    if (vertex_count_ > limits().vertices)
      place.fail(fmt::format("{} vertices up to here, {}", vertex_count_, limit_hint("vertices")));
  }

  void check_counts(const JsonPlace& attributes, std::size_t wanted) const {
    for (const std::string& name : attributes.keys()) {
      const JsonPlace place = attributes.get(name);
      const std::size_t found =
          document_.accessors[place.index(document_.accessors.size(), "accessor")].count;
      if (found != wanted) place.fail(fmt::format("{} elements, POSITION has {}", found, wanted));
      if (!is_known(name))
        issues_.note("attribute-left-out", document_.at(place), "the vertex attribute is not used");
    }
  }

  static bool is_known(const std::string& name) {
    return name == "POSITION" || name == "NORMAL" || name == "TANGENT" || name == "COLOR_0" ||
           name.starts_with("TEXCOORD_") || name.starts_with("JOINTS_") || name.starts_with("WEIGHTS_");
  }

  template <class Vec>
  static std::vector<Vec> vectors(const GltfAccessor& accessor) {
    const GltfValues values = GltfAccessors::values(accessor);
    std::vector<Vec> list;
    list.reserve(values.count);
    for (std::size_t i = 0; i < values.count; ++i) list.push_back(Eigen::Map<const Vec>(values[i]));
    return list;
  }

  /// Vectors of an attribute that a mesh can do without: what is not finite becomes zero.
  template <class Vec>
  std::vector<Vec> repaired(const JsonPlace& place, const GltfAccessor& accessor) {
    std::vector<Vec> list = vectors<Vec>(accessor);
    std::size_t bad = 0;
    for (Vec& v : list)
      if (!v.allFinite()) {
        v.setZero();
        ++bad;
      }
    if (bad > 0)
      issues_.warn("attribute-not-finite", document_.at(place),
                   fmt::format("{} of {} values were not finite and are 0 now", bad, list.size()));
    return list;
  }

  void read_shading(const JsonPlace& attributes, Primitive& primitive) {
    if (const auto place = attributes.find("NORMAL"))
      primitive.normals = repaired<Vec3>(*place, document_.accessors.find(*place, {"VEC3"}, kAnyType));
    for (std::size_t set = 0; set < kMaxUvSets; ++set)
      if (const auto place = attributes.find(numbered("TEXCOORD", set))) {
        primitive.uvs.resize(set + 1, std::vector<Vec2>(primitive.positions.size(), Vec2::Zero()));
        primitive.uvs[set] = repaired<Vec2>(*place, document_.accessors.find(*place, {"VEC2"}, kAnyType));
      }
    if (const auto place = attributes.find("COLOR_0")) read_colors(*place, primitive);
  }

  void read_colors(const JsonPlace& place, Primitive& primitive) {
    const GltfAccessor& accessor = document_.accessors.find(place, {"VEC3", "VEC4"}, kFloatOrUnsigned);
    if (accessor.components == 4) {
      primitive.colors = repaired<Vec4>(place, accessor);
      return;
    }
    for (const Vec3& color : repaired<Vec3>(place, accessor))
      primitive.colors.emplace_back(color.x(), color.y(), color.z(), 1);
  }

  struct WeightSet {
    GltfValues joints;
    GltfValues weights;
    JsonPlace place;
  };

  std::vector<WeightSet> weight_sets(const JsonPlace& attributes) const {
    std::vector<WeightSet> sets;
    for (std::size_t s = 0;; ++s) {
      const auto joints = attributes.find(numbered("JOINTS", s));
      const auto weights = attributes.find(numbered("WEIGHTS", s));
      if (joints.has_value() != weights.has_value())
        attributes.fail(fmt::format("only one of JOINTS_{0} and WEIGHTS_{0}", s));
      if (!joints) return sets;
      if (s == kMaxWeightSets)
        joints->fail(fmt::format("more than {} influences a vertex", 4 * kMaxWeightSets));
      const auto& joint_accessor =
          document_.accessors.find(*joints, {"VEC4"}, {gltf::kUnsignedByte, gltf::kUnsignedShort});
      const auto& weight_accessor = document_.accessors.find(*weights, {"VEC4"}, kFloatOrUnsigned);
      sets.push_back(
          {GltfAccessors::values(joint_accessor), GltfAccessors::values(weight_accessor), *joints});
    }
  }

  void read_weights(const JsonPlace& attributes, std::size_t joint_limit, Primitive& primitive) {
    const std::vector<WeightSet> sets = weight_sets(attributes);
    if (sets.empty() && joint_limit != kNoSkin)
      issues_.warn("skin-without-weights", document_.at(attributes),
                   "the mesh has a skin, the primitive has no weights");
    if (!sets.empty() && joint_limit == kNoSkin) {
      issues_.note("weights-without-skin", document_.at(attributes),
                   "no node uses the weights of the primitive with a skin");
      return;
    }
    if (sets.empty()) return;
    std::size_t idle = 0;  // slots of weight 0 that name a joint the skin does not have
    primitive.weight_begin.push_back(0);
    for (std::size_t v = 0; v < primitive.positions.size(); ++v) {
      for (const WeightSet& set : sets) idle += add_influences(set, v, joint_limit, primitive);
      primitive.weight_begin.push_back(static_cast<std::int32_t>(primitive.weight_joint.size()));
    }
    if (idle > 0)
      issues_.warn("joint-out-of-range", document_.at(attributes),
                   fmt::format("{} influences of weight 0 name a joint that the skin does not have", idle));
  }

  static std::size_t add_influences(const WeightSet& set, std::size_t vertex, std::size_t joint_limit,
                                    Primitive& primitive) {
    std::size_t idle = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const double weight = set.weights[vertex][k];
      const double joint = set.joints[vertex][k];
      const bool exists = joint < static_cast<double>(joint_limit);
      if (weight == 0) {
        idle += exists ? 0 : 1;
        continue;
      }
      if (!exists)
        set.place.fail(fmt::format("vertex {} uses joint {} of {} with weight {:.4g}", vertex, joint,
                                   joint_limit, weight));
      primitive.weight_joint.push_back(static_cast<std::int32_t>(joint));
      primitive.weight_value.push_back(weight);
    }
    return idle;
  }

  /// The largest value of an index type names no vertex (glTF 2.0, section 3.7.2.1).
  static double restart_index(int component_type) {
    if (component_type == gltf::kUnsignedByte) return 0xFF;
    return component_type == gltf::kUnsignedShort ? 0xFFFF : 0xFFFFFFFF;
  }

  std::vector<std::int32_t> vertex_list(const JsonPlace& place, std::size_t vertex_count) const {
    std::vector<std::int32_t> list;
    const auto reference = place.find("indices");
    if (!reference) {
      for (std::size_t i = 0; i < vertex_count; ++i) list.push_back(static_cast<std::int32_t>(i));
      return list;
    }
    const GltfAccessor& accessor = document_.accessors.find(
        *reference, {"SCALAR"}, {gltf::kUnsignedByte, gltf::kUnsignedShort, gltf::kUnsignedInt});
    const GltfValues values = GltfAccessors::values(accessor);
    const double restart = restart_index(accessor.component_type);
    for (std::size_t i = 0; i < values.count; ++i) {
      if (values.numbers[i] == restart)
        reference->fail(fmt::format("element {} is {}, which would restart a primitive", i, restart));
      if (values.numbers[i] >= static_cast<double>(vertex_count))
        reference->fail(fmt::format("index {} at element {}, the primitive has {} vertices",
                                    values.numbers[i], i, vertex_count));
      list.push_back(static_cast<std::int32_t>(values.numbers[i]));
    }
    return list;
  }

  void read_faces(const JsonPlace& place, std::size_t mode, const std::vector<std::int32_t>& list,
                  Primitive& primitive) {
    if (mode == kTriangles && list.size() % 3 != 0)
      issues_.warn("triangle-incomplete", document_.at(place),
                   fmt::format("{} indices are not whole triangles; the rest is left out", list.size()));
    const auto extensions = place.find("extensions");
    const bool has_polygons = mode == kTriangles && extensions && extensions->has("FB_ngon_encoding");
    if (has_polygons) scene_.triangles_only = false;
    const auto triangles = triangles_of(list, mode);
    has_polygons ? add_polygons(primitive, triangles) : add_triangles(primitive, triangles);
  }

  void read_targets(const JsonPlace& place, Primitive& primitive) {
    for (const JsonPlace& target : place.objects("targets")) {
      count_vertices(target, primitive.positions.size());
      primitive.morph_offsets.emplace_back(primitive.positions.size(), Vec3::Zero());
      for (const std::string& name : target.keys()) read_target_attribute(target.get(name), name, primitive);
    }
  }

  void read_target_attribute(const JsonPlace& place, const std::string& name, Primitive& primitive) {
    const GltfAccessor& accessor = document_.accessors[place.index(document_.accessors.size(), "accessor")];
    if (accessor.count != primitive.positions.size())
      place.fail(fmt::format("{} elements, POSITION has {}", accessor.count, primitive.positions.size()));
    if (name == "POSITION")
      primitive.morph_offsets.back() = vectors<Vec3>(document_.accessors.find(place, {"VEC3"}, kAnyType));
    else
      issues_.note("morph-attribute-left-out", document_.at(place),
                   "only positions of morph targets are kept");
  }

  static constexpr std::initializer_list<int> kAnyType = {
      gltf::kByte, gltf::kUnsignedByte, gltf::kShort, gltf::kUnsignedShort, gltf::kUnsignedInt, gltf::kFloat};
  static constexpr std::initializer_list<int> kFloatOrUnsigned = {gltf::kFloat, gltf::kUnsignedByte,
                                                                  gltf::kUnsignedShort};

  const GltfDocument& document_;
  RawScene& scene_;
  IssueSink& issues_;
  std::size_t material_count_ = 0;
  std::size_t vertex_count_ = 0;          ///< of all primitives and morph targets
  std::vector<std::size_t> joint_limit_;  ///< per mesh, joints of its skin
};

}  // namespace

void read_meshes(const GltfDocument& document, RawScene& scene, IssueSink& issues) {
  MeshReader(document, scene, issues).read();
}

}  // namespace skinforge
