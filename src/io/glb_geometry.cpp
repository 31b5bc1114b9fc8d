#include "io/glb_geometry.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <tuple>

#include "io/glb_polygons.h"
#include "io/glb_tangents.h"

namespace skinforge {
namespace {

constexpr int kMaxUvSets = 8;

/// UV sets that textures of a material read: 1 + the highest index.
int needed_uv_sets(const Material& material) {
  int needed = 0;
  for (const auto* texture :
       {&material.base_color_texture, &material.metallic_roughness_texture, &material.normal_texture,
        &material.occlusion_texture, &material.emissive_texture})
    if (*texture) needed = std::max(needed, (*texture)->uv_set + 1);
  return std::min(needed, kMaxUvSets);
}

/// What corners must share to go into one primitive; sorted in the order in which primitives are written.
struct PrimitiveKey {
  PartId morph_part;
  MaterialId material;
  int uv_sets = 0;
  bool has_colors = false;

  auto operator<=>(const PrimitiveKey&) const = default;
};

class PrimitiveBuilder {
 public:
  PrimitiveBuilder(const Character& character, const PrimitiveKey& key)
      : mesh_(character.mesh), uv_sets_(static_cast<std::size_t>(key.uv_sets)), has_colors_(key.has_colors) {
    if (key.material.is_valid()) normal_texture_ = character.materials[key.material.index()].normal_texture;
    has_tangents_ =
        normal_texture_.has_value() && static_cast<std::size_t>(normal_texture_->uv_set) < uv_sets_;
    width_ = 3 + 2 * uv_sets_ + (has_colors_ ? 4 : 0) + (has_tangents_ ? 1 : 0);
    first_of_.assign(mesh_.vertex_count(), -1);
  }

  void add_face(FaceId face) {
    const auto vertices = mesh_.face(face);
    const std::size_t begin = mesh_.first_corner(face);
    std::vector<Vec3> positions;
    for (const VertexId v : vertices) positions.push_back(mesh_.positions[v.index()]);
    const Vec3 normal = area_normal(mesh_, face).normalized();
    const float handedness = has_tangents_ ? uv_handedness(corner_uvs(begin, vertices.size())) : 1.0F;
    if (const SplitNormals* split = mesh_.split_of(face))
      return add_halves(face, begin, positions, *split, handedness);
    std::vector<std::uint32_t> written;
    for (std::size_t i = 0; i < vertices.size(); ++i)
      written.push_back(vertex_of(
          vertices[i], attributes(begin + i, written_normal(mesh_.normals[begin + i], normal), handedness)));
    add_polygon(face, positions, std::move(written));
  }

  GlbPrimitive finish(MaterialId material) const {
    GlbPrimitive primitive;
    primitive.material = material;
    primitive.vertex = vertex_;
    primitive.indices = fans_.indices();
    primitive.faces = faces_;
    for (const VertexId v : vertex_)
      for (const double x : mesh_.positions[v.index()]) primitive.positions.push_back(static_cast<float>(x));
    primitive.normals = columns(0, 3);
    for (std::size_t set = 0; set < uv_sets_; ++set) primitive.uvs.push_back(columns(3 + 2 * set, 2));
    if (has_colors_) primitive.colors = columns(3 + 2 * uv_sets_, 4);
    if (has_tangents_)
      primitive.tangents = vertex_tangents({polygons_, primitive.positions, primitive.normals,
                                            primitive.uvs[static_cast<std::size_t>(normal_texture_->uv_set)],
                                            columns(width_ - 1, 1)});
    return primitive;
  }

 private:
  void add_polygon(FaceId face, std::span<const Vec3> positions, std::vector<std::uint32_t> written) {
    fans_.add(positions, written);
    faces_.resize(fans_.indices().size() / 3, face);
    polygons_.push_back(std::move(written));
  }

  /// A quad as the two triangles that it was in its file, with their own normals.
  void add_halves(FaceId face, std::size_t begin, std::span<const Vec3> positions, const SplitNormals& split,
                  float handedness) {
    const std::array<std::array<std::size_t, 3>, 2> halves{{{0, 1, 2}, {0, 2, 3}}};
    const std::array<std::array<Vec3, 3>, 2> normals{
        {{split.first[0], mesh_.normals[begin + 1], split.first[1]},
         {split.second[0], split.second[1], mesh_.normals[begin + 3]}}};
    for (std::size_t half = 0; half < 2; ++half) {
      std::vector<std::uint32_t> written;
      std::vector<Vec3> corners;
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t corner = halves[half][i];
        corners.push_back(positions[corner]);
        written.push_back(vertex_of(
            mesh_.corners[begin + corner],
            attributes(begin + corner, written_normal(normals[half][i], Vec3::Zero()), handedness)));
      }
      add_polygon(face, corners, std::move(written));
    }
  }

  Vec2 uv(std::size_t set, std::size_t corner) const {
    return set < mesh_.uvs.size() ? mesh_.uvs[set][corner] : Vec2::Zero();
  }

  std::vector<Vec2> corner_uvs(std::size_t begin, std::size_t count) const {
    std::vector<Vec2> list;
    for (std::size_t i = 0; i < count; ++i)
      list.push_back(uv(static_cast<std::size_t>(normal_texture_->uv_set), begin + i));
    return list;
  }

  /// Everything of a corner but its position, as it will be written.
  std::vector<float> attributes(std::size_t corner, const Vec3& normal, float handedness) const {
    std::vector<float> row;
    row.reserve(width_);
    const auto put = [&](const auto& vector) {
      for (const double x : vector) row.push_back(static_cast<float>(x));
    };
    put(normal);
    for (std::size_t set = 0; set < uv_sets_; ++set) put(uv(set, corner));
    if (has_colors_) put(written_color(corner));
    if (has_tangents_) row.push_back(handedness);
    return row;
  }

  static Vec3 written_normal(const Vec3& normal, const Vec3& face_normal) {
    const double length = normal.norm();
    if (length > 0) return normal / length;
    return face_normal.isZero(0) ? Vec3::UnitY() : face_normal;  // a face without area has no normal at all
  }

  Vec4 written_color(std::size_t corner) const {
    return mesh_.colors.empty() ? Vec4::Ones() : mesh_.colors[corner].cwiseMax(0).cwiseMin(1).eval();
  }

  /// The written vertex with these attributes; made when it is not there yet.
  std::uint32_t vertex_of(VertexId vertex, const std::vector<float>& row) {
    std::int32_t* slot = &first_of_[vertex.index()];
    while (*slot >= 0) {
      const auto known = static_cast<std::size_t>(*slot);
      if (std::equal(row.begin(), row.end(), rows_.begin() + static_cast<std::ptrdiff_t>(known * width_)))
        return static_cast<std::uint32_t>(known);
      slot = &next_of_[known];
    }
    *slot = static_cast<std::int32_t>(vertex_.size());
    vertex_.push_back(vertex);
    next_of_.push_back(-1);
    rows_.insert(rows_.end(), row.begin(), row.end());
    return static_cast<std::uint32_t>(vertex_.size() - 1);
  }

  std::vector<float> columns(std::size_t first, std::size_t count) const {
    std::vector<float> values;
    values.reserve(vertex_.size() * count);
    for (std::size_t v = 0; v < vertex_.size(); ++v)
      for (std::size_t c = 0; c < count; ++c) values.push_back(rows_[v * width_ + first + c]);
    return values;
  }

  const PolygonMesh& mesh_;
  std::size_t uv_sets_;
  bool has_colors_;
  bool has_tangents_ = false;
  std::optional<TextureRef> normal_texture_;
  std::size_t width_ = 3;               ///< floats of one row
  std::vector<float> rows_;             ///< per written vertex, its attributes
  std::vector<VertexId> vertex_;        ///< per written vertex
  std::vector<std::int32_t> first_of_;  ///< per vertex of the character, its first written vertex
  std::vector<std::int32_t> next_of_;   ///< per written vertex, the next one of the same vertex
  std::vector<std::vector<std::uint32_t>> polygons_;
  std::vector<FaceId> faces_;  ///< per triangle
  FanWriter fans_;
};

PrimitiveKey key_of(const Character& character, const std::set<PartId>& with_morphs, FaceId face) {
  const PartId part = character.mesh.face_part[face.index()];
  const MeshPart& attributes = character.mesh.parts[part.index()];
  PrimitiveKey key;
  if (with_morphs.contains(part)) key.morph_part = part;
  key.material = character.mesh.face_material[face.index()];
  key.uv_sets = std::min(attributes.uv_sets, kMaxUvSets);
  if (key.material.is_valid())
    key.uv_sets = std::max(key.uv_sets, needed_uv_sets(character.materials[key.material.index()]));
  key.has_colors = attributes.has_colors;
  return key;
}

std::string mesh_name(const Character& character, PartId morph_part) {
  if (morph_part.is_valid()) return character.mesh.parts[morph_part.index()].name;
  return character.name;
}

}  // namespace

std::vector<GlbMesh> glb_meshes(const Character& character) {
  std::set<PartId> with_morphs;
  for (const MorphTarget& target : character.morphs) with_morphs.insert(target.part);
  std::map<PrimitiveKey, PrimitiveBuilder> builders;
  for (std::size_t f = 0; f < character.mesh.face_count(); ++f) {
    const PrimitiveKey key = key_of(character, with_morphs, FaceId(f));
    builders.try_emplace(key, character, key).first->second.add_face(FaceId(f));
  }
  std::vector<GlbMesh> meshes;
  for (const auto& [key, builder] : builders) {
    if (meshes.empty() || meshes.back().morph_part != key.morph_part)
      meshes.push_back({mesh_name(character, key.morph_part), key.morph_part, {}});
    meshes.back().primitives.push_back(builder.finish(key.material));
  }
  return meshes;
}

}  // namespace skinforge
