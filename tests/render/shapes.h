#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "model/material.h"
#include "model/polygon_mesh.h"

namespace skinforge::testing {

/// A mesh of one part without faces; `add_face` fills it.
inline PolygonMesh empty_mesh() {
  PolygonMesh mesh;
  mesh.face_begin = {0};
  mesh.uvs.resize(1);
  mesh.parts.push_back({"part", 1, true, false});
  return mesh;
}

/// Adds a polygon with its own vertices, flat-shaded, UVs (0,0) (1,0) (1,1) (0,1).
inline void add_face(PolygonMesh& mesh, std::span<const Vec3> corners, MaterialId material = MaterialId(0)) {
  const std::array<Vec2, 4> uvs{Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)};
  const Vec3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    mesh.corners.push_back(VertexId(mesh.positions.size()));
    mesh.positions.push_back(corners[i]);
    mesh.normals.push_back(normal);
    mesh.uvs[0].push_back(uvs[i % 4]);
  }
  mesh.face_begin.push_back(static_cast<std::int32_t>(mesh.corners.size()));
  mesh.face_material.push_back(material);
  mesh.face_part.push_back(PartId(0));
}

/// A square in the plane z = `z`, facing +z, with its centre on the z axis.
inline void add_square(PolygonMesh& mesh, double half, double z, MaterialId material = MaterialId(0)) {
  const std::array<Vec3, 4> corners{Vec3(-half, -half, z), Vec3(half, -half, z), Vec3(half, half, z),
                                    Vec3(-half, half, z)};
  add_face(mesh, corners, material);
}

/// A closed torus around the y axis with shared vertices, smooth normals and quads.
inline PolygonMesh torus(int around = 24, int across = 12, double ring = 0.7, double tube = 0.3) {
  PolygonMesh mesh = empty_mesh();
  const auto angle = [](int i, int n) { return 2 * std::numbers::pi * i / n; };
  const auto normal = [&](int i, int j) {
    const double a = angle(i, around), b = angle(j, across);
    return Vec3(std::cos(b) * std::sin(a), std::sin(b), std::cos(b) * std::cos(a));
  };
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j) {
      const double a = angle(i, around);
      mesh.positions.push_back(ring * Vec3(std::sin(a), 0, std::cos(a)) + tube * normal(i, j));
    }
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j) {
      for (const auto& [di, dj] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
        mesh.corners.push_back(VertexId((i + di) % around * across + (j + dj) % across));
        mesh.normals.push_back(normal(i + di, j + dj));
        mesh.uvs[0].emplace_back(static_cast<double>(i + di) / around, static_cast<double>(j + dj) / across);
      }
      mesh.face_begin.push_back(static_cast<std::int32_t>(mesh.corners.size()));
      mesh.face_material.push_back(MaterialId(0));
      mesh.face_part.push_back(PartId(0));
    }
  return mesh;
}

/// A material whose base colour is shown as it is.
inline Material unlit(const Vec4& color) {
  Material material;
  material.base_color = color;
  material.unlit = true;
  return material;
}

inline std::array<int, 3> pixel(const Raster& raster, int x, int y) {
  const auto* p = raster.rgba.data() + 4 * (static_cast<std::size_t>(y) * raster.width + x);
  return {p[0], p[1], p[2]};
}

}  // namespace skinforge::testing
