#include "io/build_mesh.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <queue>

namespace skinforge {
namespace {

constexpr double kWeld = 1e-6;  // of the diagonal: assets.md counts vertices this way
constexpr double kSameWeights =
    1e-3;  // ours: in each weight; vertices at one place that differ by more move apart and stay two

using Row = std::vector<Influence>;

struct Repairs {
  std::size_t bad_weights = 0, scaled_rows = 0, empty_rows = 0, degenerate_faces = 0, split_welds = 0;
};

// A mesh node on its way into the character: what places and carries its vertices.
struct Placing {
  Affine3 model_from_mesh = Affine3::Identity();
  const std::vector<JointId>* skin_joints = nullptr;  // null: rigid
  JointId carrier;                                    // of a rigid part
};

// Weights as stored -> normal form. Empty when nothing positive is left.
Row repaired_row(const RawScene::Primitive& primitive, std::size_t v, const Placing& placing,
                 Repairs& repairs) {
  if (!placing.skin_joints) return {{placing.carrier, 1.0}};
  if (primitive.weight_begin.empty()) return {};
  constexpr double kSum = 1e-3;  // ours: a row this far from 1 was not merely rounded
  Row row;
  double sum = 0;
  bool is_bad = false;
  for (std::int32_t i = primitive.weight_begin[v]; i < primitive.weight_begin[v + 1]; ++i) {
    const double weight = primitive.weight_value[i];
    is_bad |= !std::isfinite(weight) || weight < 0;
    if (!(weight > 0) || !std::isfinite(weight)) continue;
    row.push_back({(*placing.skin_joints)[primitive.weight_joint[i]], weight});
    sum += weight;
  }
  repairs.bad_weights += is_bad;
  repairs.scaled_rows += !row.empty() && std::abs(sum - 1) > kSum;
  return normalised_row(std::move(row));
}

bool same_row(const Row& a, const Row& b) {
  const auto weight_in = [](const Row& row, JointId joint) {
    for (const Influence& i : row)
      if (i.joint == joint) return i.weight;
    return 0.0;
  };
  const auto covers = [&](const Row& x, const Row& y) {
    return std::all_of(x.begin(), x.end(), [&](const Influence& i) {
      return std::abs(i.weight - weight_in(y, i.joint)) <= kSameWeights;
    });
  };
  return covers(a, b) && covers(b, a);
}

/// Collects welded vertices of one part after the other.
class Welder {
 public:
  Welder(double cell, Repairs& repairs) : cell_(cell), repairs_(repairs) {}

  void start_part() { found_.clear(); }

  VertexId vertex(const Vec3& position, Row row) {
    std::array<std::int64_t, 3> key{};
    for (int k = 0; k < 3; ++k) key[k] = cell_ > 0 ? std::llround(position[k] / cell_) : 0;
    std::vector<VertexId>& here = found_[key];
    for (const VertexId v : here)
      if (same_row(rows_[v.index()], row)) return v;
    repairs_.split_welds += !here.empty();
    here.push_back(VertexId(positions_.size()));
    positions_.push_back(position);
    rows_.push_back(std::move(row));
    return here.back();
  }

  std::vector<Vec3>& positions() { return positions_; }
  std::vector<Row>& rows() { return rows_; }

 private:
  double cell_;
  Repairs& repairs_;
  std::map<std::array<std::int64_t, 3>, std::vector<VertexId>> found_;
  std::vector<Vec3> positions_;
  std::vector<Row> rows_;
};

Placing placing_of(const RawScene& scene, const SceneJoints& joints, const std::vector<Affine3>& bind,
                   std::size_t n) {
  const RawScene::Node& node = scene.nodes[n];
  Placing placing;
  if (node.skin >= 0) {
    placing.model_from_mesh = joints.model_from_skin_mesh[node.skin];
    placing.skin_joints = &joints.skin_joint[node.skin];
  } else {
    placing.carrier = joints.joint_of_node[n];
    placing.model_from_mesh = bind[placing.carrier.index()];
  }
  return placing;
}

bool is_mesh_node(const RawScene& scene, std::size_t n) {
  return scene.nodes[n].mesh >= 0;
}

double placed_diagonal(const RawScene& scene, const SceneJoints& joints, const std::vector<Affine3>& bind) {
  Eigen::AlignedBox3d box;
  for (std::size_t n = 0; n < scene.nodes.size(); ++n) {
    if (!is_mesh_node(scene, n)) continue;
    const Placing placing = placing_of(scene, joints, bind, n);
    for (const auto& primitive : scene.meshes[scene.nodes[n].mesh].primitives)
      for (const Vec3& p : primitive.positions) box.extend(placing.model_from_mesh * p);
  }
  return box.isEmpty() ? 0 : box.diagonal().norm();
}

/// Adds one mesh node after the other.
class MeshBuilder {
 public:
  MeshBuilder(const RawScene& scene, const SceneJoints& joints)
      : scene_(scene),
        joints_(joints),
        bind_(bind_matrices(joints)),
        welder_(kWeld * placed_diagonal(scene, joints, bind_), repairs_) {
    std::size_t uv_sets = 0;
    for (const auto& mesh : scene.meshes)
      for (const auto& primitive : mesh.primitives) {
        uv_sets = std::max(uv_sets, primitive.uvs.size());
        has_colors_ |= !primitive.colors.empty();
      }
    result_.mesh.uvs.resize(uv_sets);
    result_.mesh.face_begin = {0};
    result_.part_of_node.resize(scene.nodes.size());
  }

  SceneMesh run() {
    for (std::size_t n = 0; n < scene_.nodes.size(); ++n)
      if (is_mesh_node(scene_, n)) add_node(n);
    result_.mesh.positions = std::move(welder_.positions());
    fill_empty_rows();
    for (const Row& row : welder_.rows()) result_.weights.push_row(row);
    return std::move(result_);
  }

  void tell(const std::string& place, IssueSink& issues) const {
    const auto warn = [&](std::size_t count, const char* code, const char* what) {
      if (count > 0) issues.warn(code, place, fmt::format("{} {}", count, what));
    };
    warn(repairs_.bad_weights, "weights-not-finite",
         "vertices had weights that are negative or no numbers; those were dropped");
    warn(repairs_.scaled_rows, "weights-normalised",
         "vertices had weights that do not sum to 1; they were scaled");
    warn(repairs_.empty_rows, "weights-missing",
         "vertices had no weight and took those of the nearest vertex that has");
    warn(repairs_.degenerate_faces, "faces-degenerate",
         "faces had fewer than three distinct corners and were dropped");
    if (repairs_.split_welds > 0)
      issues.note("weld-kept-apart", place,
                  fmt::format("{} vertices share their place with another but are weighted differently",
                              repairs_.split_welds));
  }

 private:
  void add_node(std::size_t n) {
    const RawScene::Node& node = scene_.nodes[n];
    const RawScene::Mesh& mesh = scene_.meshes[node.mesh];
    const PartId part(result_.mesh.parts.size());
    result_.part_of_node[n] = part;
    MeshPart description{node.name.empty() ? mesh.name : node.name, 0, false, false};
    for (const auto& primitive : mesh.primitives) {
      description.uv_sets = std::max(description.uv_sets, static_cast<int>(primitive.uvs.size()));
      description.has_normals |= !primitive.normals.empty();
      description.has_colors |= !primitive.colors.empty();
    }
    result_.mesh.parts.push_back(description);
    const Placing placing = placing_of(scene_, joints_, bind_, n);
    const std::size_t first_morph = result_.morphs.size();
    start_morphs(mesh, part);
    welder_.start_part();
    for (const auto& primitive : mesh.primitives) add_primitive(primitive, placing, part, first_morph);
    sort_morphs(first_morph);
  }

  void add_primitive(const RawScene::Primitive& primitive, const Placing& placing, PartId part,
                     std::size_t first_morph) {
    std::vector<VertexId> name;
    for (std::size_t v = 0; v < primitive.positions.size(); ++v)
      name.push_back(welder_.vertex(placing.model_from_mesh * primitive.positions[v],
                                    repaired_row(primitive, v, placing, repairs_)));
    const Mat3 linear = placing.model_from_mesh.linear();
    const Mat3 normal_matrix = linear.inverse().transpose();
    const bool mirrored = linear.determinant() < 0;
    for (std::size_t f = 0; f + 1 < primitive.face_begin.size(); ++f) {
      std::vector<std::int32_t> face(primitive.corners.begin() + primitive.face_begin[f],
                                     primitive.corners.begin() + primitive.face_begin[f + 1]);
      if (mirrored) std::reverse(face.begin(), face.end());
      add_face(primitive, face, name, normal_matrix, part);
    }
    for (std::size_t t = 0; t < primitive.morph_offsets.size(); ++t)
      for (std::size_t v = 0; v < name.size(); ++v)
        if (!primitive.morph_offsets[t][v].isZero(0))
          morph_offsets_[first_morph + t].try_emplace(name[v], linear * primitive.morph_offsets[t][v]);
  }

  void add_face(const RawScene::Primitive& primitive, const std::vector<std::int32_t>& face,
                const std::vector<VertexId>& name, const Mat3& normal_matrix, PartId part) {
    std::vector<std::int32_t> corners;  // corners that repeat their neighbour's vertex say nothing
    for (std::size_t k = 0; k < face.size(); ++k)
      if (name[face[k]] != name[face[(k + 1) % face.size()]]) corners.push_back(face[k]);
    if (corners.size() < 3) {
      ++repairs_.degenerate_faces;
      return;
    }
    PolygonMesh& mesh = result_.mesh;
    for (const std::int32_t c : corners) {
      mesh.corners.push_back(name[c]);
      Vec3 normal =
          primitive.normals.empty() ? Vec3(Vec3::Zero()) : Vec3(normal_matrix * primitive.normals[c]);
      mesh.normals.push_back(normal.norm() > 0 ? Vec3(normal.normalized()) : normal);
      for (std::size_t s = 0; s < mesh.uvs.size(); ++s)
        mesh.uvs[s].push_back(s < primitive.uvs.size() ? primitive.uvs[s][c] : Vec2(0, 0));
      if (has_colors_)
        mesh.colors.push_back(primitive.colors.empty() ? Vec4(Vec4::Ones()) : primitive.colors[c]);
    }
    mesh.face_begin.push_back(static_cast<std::int32_t>(mesh.corner_count()));
    mesh.face_material.push_back(primitive.material < 0 ? MaterialId() : MaterialId(primitive.material));
    mesh.face_part.push_back(part);
    fill_zero_normals(corners.size());
  }

  // A corner without a normal gets that of its face (glTF: flat shading).
  void fill_zero_normals(std::size_t count) {
    PolygonMesh& mesh = result_.mesh;
    std::vector<Vec3> ring;
    for (std::size_t c = mesh.corner_count() - count; c < mesh.corner_count(); ++c)
      ring.push_back(welder_.positions()[mesh.corners[c].index()]);
    Vec3 area = Vec3::Zero();
    for (std::size_t k = 1; k + 1 < ring.size(); ++k)
      area += (ring[k] - ring[0]).cross(ring[k + 1] - ring[0]);
    for (std::size_t c = mesh.corner_count() - count; c < mesh.corner_count(); ++c)
      if (mesh.normals[c].isZero(0) && area.norm() > 0) mesh.normals[c] = area.normalized();
  }

  void start_morphs(const RawScene::Mesh& mesh, PartId part) {
    std::size_t targets = 0;
    for (const auto& primitive : mesh.primitives) targets = std::max(targets, primitive.morph_offsets.size());
    for (std::size_t t = 0; t < targets; ++t) {
      const std::string name = t < mesh.morph_names.size() && !mesh.morph_names[t].empty()
                                   ? mesh.morph_names[t]
                                   : fmt::format("target{}", t);
      result_.morphs.push_back(
          {name, part, t < mesh.morph_weights.size() ? mesh.morph_weights[t] : 0.0, {}, {}});
      morph_offsets_.emplace_back();
    }
  }

  void sort_morphs(std::size_t first) {
    for (std::size_t t = first; t < result_.morphs.size(); ++t)
      for (const auto& [vertex, offset] : morph_offsets_[t])
        result_.morphs[t].vertices.push_back(vertex), result_.morphs[t].offsets.push_back(offset);
  }

  // Rows without any weight take that of the nearest vertex along the faces, else the root's.
  void fill_empty_rows() {
    std::vector<Row>& rows = welder_.rows();
    for (const Row& row : rows) repairs_.empty_rows += row.empty();
    if (repairs_.empty_rows == 0) return;
    std::vector<std::vector<VertexId>> neighbours(rows.size());
    for (std::size_t f = 0; f < result_.mesh.face_count(); ++f) {
      const auto face = result_.mesh.face(FaceId(f));
      for (std::size_t k = 0; k < face.size(); ++k) {
        neighbours[face[k].index()].push_back(face[(k + 1) % face.size()]);
        neighbours[face[(k + 1) % face.size()].index()].push_back(face[k]);
      }
    }
    std::queue<VertexId> front;
    for (std::size_t v = 0; v < rows.size(); ++v)
      if (!rows[v].empty()) front.push(VertexId(v));
    for (; !front.empty(); front.pop())
      for (const VertexId n : neighbours[front.front().index()])
        if (rows[n.index()].empty()) rows[n.index()] = rows[front.front().index()], front.push(n);
    for (Row& row : rows)
      if (row.empty()) row = {{JointId(0), 1.0}};
  }

  const RawScene& scene_;
  const SceneJoints& joints_;
  std::vector<Affine3> bind_;
  Repairs repairs_;
  Welder welder_;
  SceneMesh result_;
  std::vector<std::map<VertexId, Vec3>> morph_offsets_;
  bool has_colors_ = false;
};

}  // namespace

SceneMesh build_mesh(const RawScene& scene, const SceneJoints& joints, const std::string& place,
                     IssueSink& issues) {
  MeshBuilder builder(scene, joints);
  SceneMesh mesh = builder.run();
  builder.tell(place, issues);
  return mesh;
}

}  // namespace skinforge
