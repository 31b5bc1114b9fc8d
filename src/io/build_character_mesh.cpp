#include "io/build_character_mesh.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <map>

#include "base/text.h"
#include "io/build_character_weights.h"
#include "io/build_character_weld.h"

namespace skinforge {
namespace {

constexpr double kWeld = 1e-6;  // of the diagonal; design/assets.md counts welded vertices with it

/// One mesh node on its way into the character.
struct Part {
  std::size_t node = 0;
  const RawScene::Mesh* mesh = nullptr;
  Affine3 model_from_mesh;
  std::vector<std::vector<WeightRow>> rows;  ///< per primitive, per vertex
};

/// Corner attributes of a vertex as one primitive has it, in model space.
struct CornerSource {
  const RawScene::Primitive& primitive;
  Mat3 normal_map;
};

class MeshBuilder {
 public:
  MeshBuilder(const RawScene& scene, const BoundScene& bound, const JointTable& joints,
              const std::string& place, Character& character, IssueSink& issues)
      : scene_(scene), bound_(bound), joints_(joints), place_(place), target_(character), issues_(issues) {}

  std::vector<PartId> run() {
    collect_parts();
    set_tolerance();
    PolygonMesh& mesh = target_.mesh;
    mesh.face_begin = {0};
    mesh.uvs.resize(uv_sets_);
    std::vector<PartId> part_of_node(bound_.nodes.size());
    for (const Part& part : parts_) {
      part_of_node[part.node] = PartId(mesh.parts.size());
      add_part(part);
    }
    fill_empty_rows(mesh, rows_, place_, issues_);
    for (const WeightRow& row : rows_) target_.weights.push_row(row);
    return part_of_node;
  }

 private:
  std::string place_of(const RawScene::Node& node) const {
    return fmt::format("{} mesh {}", place_, printable(node.name));
  }

  void collect_parts() {
    for (std::size_t n = 0; n < scene_.nodes.size(); ++n) {
      const RawScene::Node& node = scene_.nodes[n];
      if (node.mesh < 0) continue;
      Part part;
      part.node = n;
      part.mesh = &scene_.meshes[static_cast<std::size_t>(node.mesh)];
      const bool is_skinned = node.skin >= 0 && has_weights(*part.mesh);
      const Affine3 file_from_mesh =
          is_skinned ? bound_.skin_place[static_cast<std::size_t>(node.skin)] : bound_.bind[n];
      part.model_from_mesh = scene_.metres_from_file.is_identity()
                                 ? file_from_mesh
                                 : Affine3(scene_.metres_from_file.matrix() * file_from_mesh);
      for (const auto& primitive : part.mesh->primitives) {
        part.rows.push_back(rows_of(primitive, n));
        uv_sets_ = std::max(uv_sets_, primitive.uvs.size());
        has_colors_ |= !primitive.colors.empty();
      }
      parts_.push_back(std::move(part));
    }
  }

  static bool has_weights(const RawScene::Mesh& mesh) {
    return std::any_of(mesh.primitives.begin(), mesh.primitives.end(),
                       [](const auto& p) { return !p.weight_begin.empty(); });
  }

  /// Weights of a skinned primitive; a rigid one hangs whole on the joint at or above its node.
  std::vector<WeightRow> rows_of(const RawScene::Primitive& primitive, std::size_t n) const {
    const RawScene::Node& node = scene_.nodes[n];
    if (node.skin < 0 || primitive.weight_begin.empty())
      return std::vector<WeightRow>(primitive.positions.size(), {{joints_.carrier_of_node[n], 1.0}});
    std::vector<JointId> slots;
    for (const std::int32_t joint : bound_.skin_nodes[static_cast<std::size_t>(node.skin)])
      slots.push_back(joints_.joint_of_node[static_cast<std::size_t>(joint)]);
    return weight_rows(primitive, slots, place_of(node), issues_);
  }

  void set_tolerance() {
    Eigen::AlignedBox3d box;
    for (const Part& part : parts_)
      for (const auto& primitive : part.mesh->primitives)
        for (const Vec3& p : primitive.positions) box.extend(Vec3(part.model_from_mesh * p));
    tolerance_ = box.isEmpty() ? 0 : kWeld * box.diagonal().norm();
  }

  void add_part(const Part& part) {
    const std::vector<std::vector<VertexId>> vertex = weld(part);
    const std::string& node_name = bound_.nodes[part.node].name;
    MeshPart info;
    info.name = printable(node_name.empty() ? part.mesh->name : node_name);
    Faces faces;
    for (std::size_t i = 0; i < part.mesh->primitives.size(); ++i) {
      const auto& primitive = part.mesh->primitives[i];
      info.uv_sets = std::max(info.uv_sets, static_cast<int>(primitive.uvs.size()));
      info.has_normals = true;
      info.has_colors |= !primitive.colors.empty();
      add_faces(part, primitive, vertex[i], faces);
    }
    target_.mesh.parts.push_back(info);
    report(part, faces);
    add_morphs(part, vertex);
  }

  /// What happened to the faces of one part.
  struct Faces {
    std::size_t collapsed = 0, thinned = 0, without_normals = 0, bad_normals = 0, bad_attributes = 0;
  };

  void report(const Part& part, const Faces& faces) {
    const std::string place = place_of(bound_.nodes[part.node]);
    if (faces.collapsed > 0)
      issues_.warn("faces-collapsed", place,
                   fmt::format("{} faces with fewer than 3 different vertices are dropped", faces.collapsed));
    if (faces.thinned > 0)
      issues_.note("corners-merged", place,
                   fmt::format("{} faces lost a corner that stood twice in a row", faces.thinned));
    if (faces.without_normals > 0)
      issues_.note("normals-computed", place,
                   fmt::format("{} faces had no normals; they are flat", faces.without_normals));
    if (faces.bad_normals > 0)
      issues_.warn("normals-unusable", place,
                   fmt::format("normals of {} faces were zero or no numbers; now flat", faces.bad_normals));
    if (faces.bad_attributes > 0)
      issues_.warn("attributes-not-finite", place,
                   fmt::format("{} UVs or colours were no numbers; now 0", faces.bad_attributes));
  }

  /// Vertex of each vertex of each primitive that a face uses. One place, one row, one set of morph offsets:
  /// one vertex. Rows that differ keep vertices apart, or the surface would move otherwise than in its file.
  std::vector<std::vector<VertexId>> weld(const Part& part) {
    PointIndex index(tolerance_);
    std::size_t apart = 0;
    std::vector<std::vector<VertexId>> vertices;
    for (std::size_t i = 0; i < part.mesh->primitives.size(); ++i) {
      const auto& primitive = part.mesh->primitives[i];
      std::vector<bool> used(primitive.positions.size(), false);
      for (const std::int32_t corner : primitive.corners) used[static_cast<std::size_t>(corner)] = true;
      vertices.emplace_back(primitive.positions.size());
      for (std::size_t v = 0; v < used.size(); ++v)
        if (used[v]) vertices.back()[v] = weld_vertex(part, i, v, index, apart);
    }
    source_.clear();
    if (apart > 0)
      issues_.note(
          "weld-refused", place_of(bound_.nodes[part.node]),
          fmt::format("{} vertices lie on others with other weights or shapes and stay apart", apart));
    return vertices;
  }

  VertexId weld_vertex(const Part& part, std::size_t i, std::size_t v, PointIndex& index,
                       std::size_t& apart) {
    const Vec3 position = part.model_from_mesh * part.mesh->primitives[i].positions[v];
    const std::vector<std::size_t> near = index.near(position);
    for (const std::size_t candidate : near) {
      if (!is_same_row(rows_[candidate], part.rows[i][v]) || !same_shapes(part, candidate, i, v)) continue;
      if (rows_[candidate].empty()) rows_[candidate] = part.rows[i][v];
      return VertexId(candidate);
    }
    apart += !near.empty();
    const std::size_t id = target_.mesh.positions.size();
    target_.mesh.positions.push_back(position);
    rows_.push_back(part.rows[i][v]);
    source_[id] = {i, v};
    index.add(id, position);
    return VertexId(id);
  }

  bool same_shapes(const Part& part, std::size_t candidate, std::size_t i, std::size_t v) const {
    if (part.mesh->morph_names.empty()) return true;
    const auto [j, w] = source_.at(candidate);
    for (std::size_t t = 0; t < part.mesh->morph_names.size(); ++t) {
      const Vec3 difference =
          part.mesh->primitives[i].morph_offsets[t][v] - part.mesh->primitives[j].morph_offsets[t][w];
      if ((part.model_from_mesh.linear() * difference).norm() > tolerance_) return false;
    }
    return true;
  }

  void add_faces(const Part& part, const RawScene::Primitive& primitive, const std::vector<VertexId>& vertex,
                 Faces& faces) {
    const Mat3 linear = part.model_from_mesh.linear();
    const bool mirrored = linear.determinant() < 0;
    const CornerSource source{primitive, cofactors(linear) * (mirrored ? -1.0 : 1.0)};
    for (std::size_t f = 0; f + 1 < primitive.face_begin.size(); ++f) {
      std::vector<std::int32_t> corners(primitive.corners.begin() + primitive.face_begin[f],
                                        primitive.corners.begin() + primitive.face_begin[f + 1]);
      if (mirrored) std::reverse(corners.begin(), corners.end());
      const std::size_t size = corners.size();
      drop_repeats(corners, vertex);
      if (!is_polygon(corners, vertex)) {
        ++faces.collapsed;
        continue;
      }
      faces.thinned += corners.size() < size;
      add_face(source, corners, vertex, faces);
    }
  }

  /// Normals map by these: the inverse transpose times the determinant, which exists for flat maps too.
  static Mat3 cofactors(const Mat3& m) {
    Mat3 result;
    result.col(0) = m.col(1).cross(m.col(2));
    result.col(1) = m.col(2).cross(m.col(0));
    result.col(2) = m.col(0).cross(m.col(1));
    return result;
  }

  static void drop_repeats(std::vector<std::int32_t>& corners, const std::vector<VertexId>& vertex) {
    const auto at = [&](std::int32_t corner) { return vertex[static_cast<std::size_t>(corner)]; };
    corners.erase(std::unique(corners.begin(), corners.end(),
                              [&](std::int32_t a, std::int32_t b) { return at(a) == at(b); }),
                  corners.end());
    while (corners.size() > 1 && at(corners.front()) == at(corners.back())) corners.pop_back();
  }

  static bool is_polygon(const std::vector<std::int32_t>& corners, const std::vector<VertexId>& vertex) {
    std::vector<VertexId> ids;
    for (const std::int32_t corner : corners) ids.push_back(vertex[static_cast<std::size_t>(corner)]);
    std::sort(ids.begin(), ids.end());
    return ids.size() >= 3 && std::adjacent_find(ids.begin(), ids.end()) == ids.end();
  }

  void add_face(const CornerSource& source, const std::vector<std::int32_t>& corners,
                const std::vector<VertexId>& vertex, Faces& faces) {
    PolygonMesh& mesh = target_.mesh;
    const FaceId face(mesh.face_count());
    for (const std::int32_t corner : corners)
      mesh.corners.push_back(vertex[static_cast<std::size_t>(corner)]);
    mesh.face_begin.push_back(static_cast<std::int32_t>(mesh.corners.size()));
    mesh.face_material.emplace_back(source.primitive.material);
    mesh.face_part.emplace_back(mesh.parts.size());
    const Vec3 flat = area_normal(mesh, face).stableNormalized();
    bool computed = false;
    for (const std::int32_t corner : corners) {
      const auto v = static_cast<std::size_t>(corner);
      const Vec3 normal = source.primitive.normals.empty()
                              ? Vec3::Zero()
                              : Vec3((source.normal_map * source.primitive.normals[v]).stableNormalized());
      const bool usable = normal.allFinite() && normal.squaredNorm() > 0;
      computed |= !usable;
      mesh.normals.push_back(usable ? normal : flat);
      for (std::size_t set = 0; set < mesh.uvs.size(); ++set)
        mesh.uvs[set].push_back(set < source.primitive.uvs.size()
                                    ? finite(source.primitive.uvs[set][v], faces)
                                    : Vec2(Vec2::Zero()));
      if (has_colors_)
        mesh.colors.push_back(source.primitive.colors.empty() ? Vec4(Vec4::Zero())
                                                              : finite(source.primitive.colors[v], faces));
    }
    (source.primitive.normals.empty() ? faces.without_normals : faces.bad_normals) += computed;
  }

  template <class Vector>
  static Vector finite(const Vector& value, Faces& faces) {
    if (value.allFinite()) return value;
    ++faces.bad_attributes;
    return Vector::Zero();
  }

  void add_morphs(const Part& part, const std::vector<std::vector<VertexId>>& vertex) {
    for (std::size_t t = 0; t < part.mesh->morph_names.size(); ++t) {
      MorphTarget target;
      target.name = printable(part.mesh->morph_names[t]);
      target.part = PartId(target_.mesh.parts.size() - 1);
      if (t < part.mesh->morph_weights.size()) target.default_weight = part.mesh->morph_weights[t];
      std::map<VertexId, Vec3> offsets;
      for (std::size_t i = 0; i < vertex.size(); ++i)
        for (std::size_t v = 0; v < vertex[i].size(); ++v) {
          const Vec3 offset = part.model_from_mesh.linear() * part.mesh->primitives[i].morph_offsets[t][v];
          if (vertex[i][v].is_valid() && !offset.isZero(0)) offsets.try_emplace(vertex[i][v], offset);
        }
      for (const auto& [id, offset] : offsets) {
        target.vertices.push_back(id);
        target.offsets.push_back(offset);
      }
      target_.morphs.push_back(std::move(target));
    }
  }

  const RawScene& scene_;
  const BoundScene& bound_;
  const JointTable& joints_;
  const std::string& place_;
  Character& target_;
  IssueSink& issues_;
  std::vector<Part> parts_;
  std::vector<WeightRow> rows_;                                        ///< per vertex of the character
  std::map<std::size_t, std::pair<std::size_t, std::size_t>> source_;  ///< vertex -> primitive, vertex there
  std::size_t uv_sets_ = 0;
  bool has_colors_ = false;
  double tolerance_ = 0;
};

}  // namespace

std::vector<PartId> build_mesh(const RawScene& scene, const BoundScene& bound, const JointTable& joints,
                               const std::string& place, Character& character, IssueSink& issues) {
  return MeshBuilder(scene, bound, joints, place, character, issues).run();
}

}  // namespace skinforge
