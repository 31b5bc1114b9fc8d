#include "render/subject.h"

#include <algorithm>

namespace skinforge {
namespace {

// ours: normals closer than 1.8 degrees are one normal that was rounded; artists' hard edges are far wider.
constexpr double kSameNormal = 0.9995;

TriangleIndices indices(const std::array<VertexId, 3>& t) {
  return {t[0].value, t[1].value, t[2].value};
}

// Bit i: the side opposite corner i joins two corners that follow each other around the face.
std::uint8_t polygon_edge_bits(const TriangleIndices& t, std::int32_t first, std::int32_t count) {
  int bits = 0;
  for (int i = 0; i < 3; ++i) {
    const std::int32_t a = t[static_cast<std::size_t>((i + 1) % 3)] - first;
    const std::int32_t b = t[static_cast<std::size_t>((i + 2) % 3)] - first;
    if ((a + 1) % count == b || (b + 1) % count == a) bits |= 1 << i;
  }
  return static_cast<std::uint8_t>(bits);
}

std::vector<std::vector<std::int32_t>> corners_by_vertex(const PolygonMesh& mesh) {
  std::vector<std::vector<std::int32_t>> corners(mesh.vertex_count());
  for (std::size_t c = 0; c < mesh.corner_count(); ++c)
    corners[mesh.corners[c].index()].push_back(static_cast<std::int32_t>(c));
  return corners;
}

std::vector<std::int32_t> normal_groups(const PolygonMesh& mesh) {
  std::vector<std::int32_t> group(mesh.corner_count());
  for (const auto& around : corners_by_vertex(mesh))
    for (std::size_t i = 0; i < around.size(); ++i) {
      const std::int32_t corner = around[i];
      group[corner] = corner;
      for (std::size_t j = 0; j < i; ++j) {
        if (group[around[j]] != around[j]) continue;
        if (mesh.normals[corner].dot(mesh.normals[around[j]]) < kSameNormal) continue;
        group[corner] = around[j];
        break;
      }
    }
  return group;
}

Vec3 area_normal_at(const PolygonMesh& mesh, FaceId face, std::span<const Vec3> positions) {
  const auto corners = mesh.face(face);
  const Vec3& origin = positions[corners[0].index()];
  Vec3 normal = Vec3::Zero();
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
    normal += (positions[corners[i].index()] - origin).cross(positions[corners[i + 1].index()] - origin);
  return normal;
}

}  // namespace

Subject::Subject(const PolygonMesh& mesh, std::span<const Material> materials, std::span<const Raster> images)
    : mesh_(&mesh), materials_(materials), textures_(images), normal_group_(normal_groups(mesh)) {
  default_material_.metallic = 0;
  const Triangulation t = triangulate(mesh);
  triangle_corners_ = t.corners;
  triangle_face_ = t.face;
  for (std::size_t i = 0; i < t.triangles.size(); ++i) {
    triangles_.push_back(indices(t.triangles[i]));
    const FaceId face = t.face[i];
    polygon_edges_.push_back(polygon_edge_bits(t.corners[i],
                                               static_cast<std::int32_t>(mesh.first_corner(face)),
                                               static_cast<std::int32_t>(mesh.face(face).size())));
  }
}

const Material& Subject::material_of(FaceId face) const {
  const MaterialId id = mesh_->face_material[face.index()];
  return id.is_valid() && id.index() < materials_.size() ? materials_[id.index()] : default_material_;
}

std::vector<Vec3> Subject::normals_at(std::span<const Vec3> positions) const {
  std::vector<Vec3> sums(mesh_->corner_count(), Vec3::Zero());
  for (std::size_t f = 0; f < mesh_->face_count(); ++f) {
    const Vec3 normal = area_normal_at(*mesh_, FaceId(f), positions);
    const std::size_t first = mesh_->first_corner(FaceId(f));
    for (std::size_t c = first; c < first + mesh_->face(FaceId(f)).size(); ++c)
      sums[normal_group_[c]] += normal;
  }
  std::vector<Vec3> normals(sums.size());
  for (std::size_t c = 0; c < normals.size(); ++c) {
    const Vec3& sum = sums[normal_group_[c]];
    const double length = sum.norm();
    if (length > 0)
      normals[c] = sum / length;
    else
      normals[c] = Vec3::Zero();
  }
  return normals;
}

}  // namespace skinforge
