#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "model/polygon_mesh.h"

namespace skinforge::testing {

inline void add_quad(PolygonMesh& mesh, int a, int b, int c, int d) {
  if (mesh.face_begin.empty()) mesh.face_begin = {0};
  for (const int v : {a, b, c, d}) mesh.corners.push_back(VertexId(v));
  mesh.face_begin.push_back(static_cast<std::int32_t>(mesh.corners.size()));
  mesh.face_material.push_back(MaterialId(0));
  mesh.face_part.push_back(PartId(0));
}

/// Flat normals and one part without UVs and colours.
inline void finish(PolygonMesh& mesh) {
  mesh.parts = {{"part", 0, true, false}};
  mesh.normals.clear();
  for (std::size_t f = 0; f < mesh.face_count(); ++f)
    for (std::size_t c = 0; c < mesh.face(FaceId(f)).size(); ++c) {
      const Vec3 n = area_normal(mesh, FaceId(f));
      mesh.normals.push_back(n.norm() > 0 ? n.normalized() : Vec3(Vec3::Zero()));
    }
}

/// rows x columns unit squares in the plane z = 0, facing +z.
inline PolygonMesh flat_grid(int rows, int columns) {
  PolygonMesh mesh;
  for (int y = 0; y <= rows; ++y)
    for (int x = 0; x <= columns; ++x) mesh.positions.emplace_back(x, y, 0);
  const int step = columns + 1;
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x)
      add_quad(mesh, y * step + x, y * step + x + 1, (y + 1) * step + x + 1, (y + 1) * step + x);
  finish(mesh);
  return mesh;
}

/// A tube along x facing outwards: `rings` rings of `around` vertices, ring r at x = first + r * step.
inline PolygonMesh tube_mesh(int rings, int around, double first, double step, double radius) {
  PolygonMesh mesh;
  for (int r = 0; r < rings; ++r)
    for (int a = 0; a < around; ++a) {
      const double angle = 2 * std::numbers::pi * a / around;
      mesh.positions.emplace_back(first + r * step, radius * std::cos(angle), radius * std::sin(angle));
    }
  for (int r = 0; r + 1 < rings; ++r)
    for (int a = 0; a < around; ++a) {
      const int b = (a + 1) % around;
      add_quad(mesh, r * around + a, r * around + b, (r + 1) * around + b, (r + 1) * around + a);
    }
  finish(mesh);
  return mesh;
}

/// A flat ring in z = 0 facing +z: circles of the given radii, `around` vertices each.
inline PolygonMesh flat_ring(int around, const std::vector<double>& radii) {
  PolygonMesh mesh;
  for (const double radius : radii)
    for (int a = 0; a < around; ++a) {
      const double angle = 2 * std::numbers::pi * a / around;
      mesh.positions.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
    }
  for (int r = 0; r + 1 < static_cast<int>(radii.size()); ++r)
    for (int a = 0; a < around; ++a) {
      const int b = (a + 1) % around;
      add_quad(mesh, r * around + a, (r + 1) * around + a, (r + 1) * around + b, r * around + b);
    }
  finish(mesh);
  return mesh;
}

/// A spiral stair without steps: `count` quads, `per_turn` of them a turn, rising gently.
inline PolygonMesh spiral(int count, int per_turn) {
  PolygonMesh mesh;
  for (int i = 0; i <= count; ++i) {
    const double angle = 2 * std::numbers::pi * i / per_turn;
    for (const double radius : {1.0, 2.0})
      mesh.positions.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.02 * i);
  }
  for (int i = 0; i < count; ++i) add_quad(mesh, 2 * i, 2 * i + 1, 2 * i + 3, 2 * i + 2);
  finish(mesh);
  return mesh;
}

inline std::vector<FaceId> all_faces(const PolygonMesh& mesh) {
  std::vector<FaceId> faces;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) faces.push_back(FaceId(f));
  return faces;
}

}  // namespace skinforge::testing
