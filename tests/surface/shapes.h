#pragma once

#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <set>
#include <vector>

#include "geometry/mesh_measures.h"
#include "surface/triangle_patch.h"
#include "testing/shapes.h"

namespace skinforge::testing {

/// Counts and faults of a list of triangles.
inline MeshTopology topology_of(const TrianglePatch& patch) {
  return measure_topology(polygon_mesh(Soup{patch.positions, patch.triangles}));
}

inline double area_of(const TrianglePatch& patch) {
  double area = 0;
  for (const Triangle& t : patch.triangles)
    area += 0.5 * (patch.positions[t[1]] - patch.positions[t[0]])
                      .cross(patch.positions[t[2]] - patch.positions[t[0]])
                      .norm();
  return area;
}

/// How often triangles run along each directed edge.
inline std::map<std::pair<std::int32_t, std::int32_t>, int> half_edge_uses(
    const std::vector<Triangle>& triangles) {
  std::map<std::pair<std::int32_t, std::int32_t>, int> uses;
  for (const Triangle& t : triangles)
    for (int k = 0; k < 3; ++k) ++uses[{t[k], t[(k + 1) % 3]}];
  return uses;
}

/// Inner edges between two fixed vertices.
inline int chord_count(const TrianglePatch& patch) {
  const auto uses = half_edge_uses(patch.triangles);
  const auto fixed = static_cast<std::int32_t>(patch.fixed);
  int count = 0;
  for (const auto& [edge, number] : uses)
    count += edge.first < edge.second && edge.second < fixed && uses.contains({edge.second, edge.first});
  return count;
}

/// A regular polygon about the y axis at that height, counter-clockwise seen from +y.
inline std::vector<Vec3> ring(int count, double radius = 1, double height = 0, double turn = 0) {
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) {
    const double angle = turn + 2 * std::numbers::pi * i / count;
    points.emplace_back(radius * std::sin(angle), height, radius * std::cos(angle));
  }
  return points;
}

/// `x_count` by `y_count` unit squares in the plane z = 0, facing +z: vertex (x, y) is x + (x_count + 1) * y,
/// face (x, y) is x + x_count * y.
inline PolygonMesh quad_grid(int x_count, int y_count) {
  std::vector<Vec3> positions;
  for (int y = 0; y <= y_count; ++y)
    for (int x = 0; x <= x_count; ++x) positions.emplace_back(x, y, 0);
  std::vector<std::vector<int>> faces;
  const int row = x_count + 1;
  for (int y = 0; y < y_count; ++y)
    for (int x = 0; x < x_count; ++x)
      faces.push_back({x + row * y, x + 1 + row * y, x + 1 + row * (y + 1), x + row * (y + 1)});
  return polygon_mesh(positions, faces);
}

/// A flat open sheet in the plane y = 0 along x, `y_count` squares wide about the x axis.
inline PolygonMesh sheet_along_x(int x_count, int y_count, double first, double step) {
  PolygonMesh mesh = quad_grid(x_count, y_count);
  for (Vec3& p : mesh.positions) p = Vec3(first + p.x() * step, 0, (p.y() - 0.5 * y_count) * step);
  return mesh;
}

/// An open tube along x in quads, outward: ring r at x = first + r * step, vertex a of it is r * around + a.
inline PolygonMesh open_tube(int rings, int around, double first, double step, double radius) {
  std::vector<Vec3> positions;
  for (int r = 0; r < rings; ++r)
    for (int a = 0; a < around; ++a) {
      const double angle = 2 * std::numbers::pi * a / around;
      positions.emplace_back(first + r * step, radius * std::cos(angle), radius * std::sin(angle));
    }
  std::vector<std::vector<int>> faces;
  for (int r = 0; r + 1 < rings; ++r)
    for (int a = 0; a < around; ++a) {
      const int b = (a + 1) % around;
      faces.push_back({r * around + a, r * around + b, (r + 1) * around + b, (r + 1) * around + a});
    }
  return polygon_mesh(positions, faces);
}

/// Both meshes' positions and faces, side by side.
inline PolygonMesh joined(const PolygonMesh& first, const PolygonMesh& second) {
  std::vector<Vec3> positions = first.positions;
  positions.insert(positions.end(), second.positions.begin(), second.positions.end());
  std::vector<std::vector<int>> faces;
  for (const PolygonMesh* mesh : {&first, &second})
    for (std::size_t f = 0; f < mesh->face_count(); ++f) {
      faces.emplace_back();
      for (const VertexId v : mesh->face(FaceId(f)))
        faces.back().push_back(v.value + (mesh == &first ? 0 : static_cast<int>(first.vertex_count())));
    }
  return polygon_mesh(positions, faces);
}

/// An open tube with a fan at either end.
inline PolygonMesh closed_tube(int rings, int around, double first, double step, double radius) {
  const PolygonMesh tube = open_tube(rings, around, first, step, radius);
  std::vector<Vec3> ends = {{first, 0, 0}, {first + (rings - 1) * step, 0, 0}};
  PolygonMesh caps = polygon_mesh(ends, {});
  PolygonMesh mesh = joined(tube, caps);
  const int low = rings * around, last = low - around;
  const auto add = [&](int a, int b, int c) {
    for (const int v : {a, b, c}) mesh.corners.push_back(VertexId(v)), mesh.normals.push_back(Vec3::Zero());
    mesh.face_begin.push_back(static_cast<std::int32_t>(mesh.corners.size()));
    mesh.face_material.emplace_back();
    mesh.face_part.emplace_back(0);
  };
  for (int a = 0; a < around; ++a) {
    const int b = (a + 1) % around;
    add(low, b, a);
    add(low + 1, last + a, last + b);
  }
  return mesh;
}

/// Unit cube moved by `at`, in quads: bottom 0, top 1, then the sides -y, +y, -x, +x. Vertex i sits at the
/// bits of i. Normals are those of the faces.
inline PolygonMesh quad_cube(const Vec3& at = Vec3::Zero()) {
  std::vector<Vec3> positions;
  for (int i = 0; i < 8; ++i) positions.push_back(at + Vec3(i & 1, (i >> 1) & 1, i >> 2));
  PolygonMesh mesh = polygon_mesh(
      positions, {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}});
  for (std::size_t c = 0; c < mesh.corner_count(); ++c)
    mesh.normals[c] = area_normal(mesh, FaceId(c / 4)).normalized();
  return mesh;
}

/// A closed box [-half, half]^3 of `cells` by `cells` quads a side, outward.
inline PolygonMesh quad_box(int cells, double half) {
  std::map<std::array<int, 3>, int> names;
  std::vector<Vec3> positions;
  std::vector<std::vector<int>> faces;
  const auto name = [&](const std::array<int, 3>& p) {
    const auto [entry, is_new] = names.try_emplace(p, static_cast<int>(positions.size()));
    if (is_new) positions.push_back(2 * half / cells * Vec3(p[0], p[1], p[2]) - Vec3::Constant(half));
    return entry->second;
  };
  for (int axis = 0; axis < 3; ++axis)
    for (const int side : {0, cells})
      for (int i = 0; i < cells; ++i)
        for (int j = 0; j < cells; ++j) {
          std::vector<int> face;
          for (const auto& [u, v] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
            std::array<int, 3> p{};
            p[axis] = side;
            p[(axis + 1) % 3] = i + u;
            p[(axis + 2) % 3] = j + v;
            face.push_back(name(p));
          }
          if (side == 0) std::swap(face[1], face[3]);
          faces.push_back(face);
        }
  return polygon_mesh(positions, faces);
}

}  // namespace skinforge::testing
