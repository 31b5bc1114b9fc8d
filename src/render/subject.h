#pragma once

#include <span>
#include <vector>

#include "model/material.h"
#include "model/polygon_mesh.h"
#include "render/depth_map.h"
#include "render/texture_set.h"

namespace skinforge {

/// A character made ready for any number of pictures: triangles, which of their sides are edges of polygons,
/// which corners share a normal, textures with their halved levels. Refers to the mesh and the materials:
/// they must outlive it.
class Subject {
 public:
  /// `images`: decoded, by ImageId; missing or empty ones are white.
  Subject(const PolygonMesh& mesh, std::span<const Material> materials, std::span<const Raster> images = {});

  const PolygonMesh& mesh() const { return *mesh_; }
  const TextureSet& textures() const { return textures_; }
  std::span<const TriangleIndices> triangles() const { return triangles_; }
  std::span<const TriangleIndices> triangle_corners() const { return triangle_corners_; }
  FaceId face_of(std::size_t triangle) const { return triangle_face_[triangle]; }
  /// Whether the side of a triangle opposite its corner 0, 1 or 2 is an edge of the polygon (not a diagonal).
  bool is_polygon_edge(std::size_t triangle, int opposite) const {
    return (polygon_edges_[triangle] >> opposite & 1) != 0;
  }
  /// The material of a face; the default one where it has none.
  const Material& material_of(FaceId face) const;

  /// Corner normals (#C, unit; zero for degenerate faces) of the mesh moved to `positions` (#V):
  /// area-weighted over the faces around a vertex whose rest normals agree at it, so smooth places stay
  /// smooth and hard edges hard. Corners without a rest normal get their face's. Linear.
  std::vector<Vec3> normals_at(std::span<const Vec3> positions) const;

 private:
  const PolygonMesh* mesh_;
  std::span<const Material> materials_;
  Material default_material_;
  TextureSet textures_;
  std::vector<TriangleIndices> triangles_, triangle_corners_;
  std::vector<FaceId> triangle_face_;
  std::vector<std::uint8_t> polygon_edges_;
  std::vector<std::int32_t> normal_group_;  ///< #C: the first corner that shares this corner's normal
};

}  // namespace skinforge
