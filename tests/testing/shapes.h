#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "base/math.h"
#include "model/polygon_mesh.h"

namespace skinforge::testing {

/// Triangles over shared positions.
struct Soup {
  std::vector<Vec3> positions;
  std::vector<std::array<std::int32_t, 3>> triangles;
};

/// Cube [0, side]^3, 12 triangles, outward.
inline Soup cube_soup(double side = 1) {
  Soup s;
  for (int i = 0; i < 8; ++i) s.positions.push_back(side * Vec3(i & 1, (i >> 1) & 1, i >> 2));
  s.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                 {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return s;
}

/// Sphere about `centre` of `rows` rings and 2 * `rows` columns, outward, closed.
inline Soup sphere_soup(int rows, double radius = 1, const Vec3& centre = Vec3::Zero()) {
  Soup s;
  const int columns = 2 * rows;
  s.positions.push_back(centre + radius * Vec3::UnitY());
  for (int i = 1; i < rows; ++i)
    for (int j = 0; j < columns; ++j) {
      const double a = std::numbers::pi * i / rows, b = 2 * std::numbers::pi * j / columns;
      s.positions.push_back(centre +
                            radius * Vec3(std::sin(a) * std::sin(b), std::cos(a), std::sin(a) * std::cos(b)));
    }
  s.positions.push_back(centre - radius * Vec3::UnitY());
  const int bottom = static_cast<int>(s.positions.size()) - 1;
  const auto at = [&](int i, int j) { return 1 + (i - 1) * columns + j % columns; };
  for (int j = 0; j < columns; ++j) {
    s.triangles.push_back({0, at(1, j), at(1, j + 1)});
    s.triangles.push_back({bottom, at(rows - 1, j + 1), at(rows - 1, j)});
    for (int i = 1; i + 1 < rows; ++i) {
      s.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      s.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return s;
}

/// Closed tube around a trefoil-like knot, outward: 2 * `along` * `around` triangles.
inline Soup torus_knot_soup(int along, int around, double radius = 0.4) {
  Soup s;
  const auto curve = [](double t) {
    const double r = 2 + std::cos(3 * t);
    return Vec3(r * std::cos(2 * t), r * std::sin(2 * t), -std::sin(3 * t));
  };
  for (int i = 0; i < along; ++i) {
    const double t = 2 * std::numbers::pi * i / along;
    const Vec3 tangent = (curve(t + 1e-4) - curve(t - 1e-4)).normalized();
    const Vec3 side = tangent.cross(Vec3::UnitZ()).normalized(), up = tangent.cross(side);
    for (int j = 0; j < around; ++j) {
      const double a = 2 * std::numbers::pi * j / around;
      s.positions.push_back(curve(t) + radius * (std::cos(a) * side + std::sin(a) * up));
    }
  }
  const auto at = [&](int i, int j) { return (i % along) * around + j % around; };
  for (int i = 0; i < along; ++i)
    for (int j = 0; j < around; ++j) {
      s.triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
      s.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i + 1, j)});
    }
  return s;
}

/// Triangles with corners anywhere in the unit cube, sharing nothing.
inline Soup random_soup(std::mt19937& random, int triangles) {
  std::uniform_real_distribution<double> unit(0, 1);
  Soup s;
  for (int i = 0; i < triangles; ++i) {
    for (int k = 0; k < 3; ++k) s.positions.emplace_back(unit(random), unit(random), unit(random));
    s.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return s;
}

/// A mesh with those faces, one part, no attributes but zero normals.
inline PolygonMesh polygon_mesh(const std::vector<Vec3>& positions,
                                const std::vector<std::vector<int>>& faces) {
  PolygonMesh mesh;
  mesh.positions = positions;
  mesh.face_begin = {0};
  mesh.parts.resize(1);
  for (const auto& face : faces) {
    for (const int v : face) mesh.corners.push_back(VertexId(v));
    mesh.face_begin.push_back(static_cast<std::int32_t>(mesh.corners.size()));
    mesh.face_material.emplace_back();
    mesh.face_part.emplace_back(0);
  }
  mesh.normals.assign(mesh.corners.size(), Vec3::Zero());
  return mesh;
}

inline PolygonMesh polygon_mesh(const Soup& soup) {
  std::vector<std::vector<int>> faces;
  for (const auto& t : soup.triangles) faces.push_back({t[0], t[1], t[2]});
  return polygon_mesh(soup.positions, faces);
}

}  // namespace skinforge::testing
