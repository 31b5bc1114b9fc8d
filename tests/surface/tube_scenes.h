#pragma once

#include <cmath>
#include <numbers>

#include "surface/improve_faces.h"
#include "surface/junction_loop.h"
#include "surface/remesh.h"
#include "surface/ring_zip.h"
#include "surface/shapes.h"
#include "surface/tube_table.h"

namespace skinforge::testing {

/// A border whose vertices are evenly apart, without corners.
inline TubeSide even_side(int count, double turn = 0) {
  TubeSide side;
  for (int k = 0; k < count; ++k) side.theta.push_back(turn + static_cast<double>(k) / count);
  side.angle.assign(side.theta.size(), std::numbers::pi);
  return side;
}

inline std::vector<double> even_heights(int rows) {
  std::vector<double> heights;
  for (int r = 0; r <= rows; ++r) heights.push_back(static_cast<double>(r) / rows);
  return heights;
}

/// A tube whose vertices were brought to where its faces are good.
inline QuadPatch finished(QuadPatch patch, const WantedSurface& surface,
                          const PatchMirror* mirror = nullptr) {
  polish(patch, surface.project);
  if (mirror) make_symmetric(patch, *mirror);
  for (const FaceGoal goal : {FaceGoal::All, FaceGoal::Worst}) improve_faces(patch, surface, goal, mirror);
  return patch;
}

/// The wall of a cylinder of radius 1 about the y axis, remeshed: borders of n and m vertices.
struct Wall {
  std::vector<JunctionLoop> loops;
  TrianglePatch domain;

  static Vec3 onto(const Vec3& p) {
    const double radius = std::hypot(p.x(), p.z());
    return {p.x() / radius, p.y(), p.z() / radius};
  }

  static WantedSurface surface() {
    return {onto, [](const Vec3& p) { return Vec3(p.x(), 0, p.z()); }};
  }

  Wall(int n, int m, double height, double turn = 0.1) {
    const std::vector<Vec3> low = testing::ring(n);
    std::vector<Vec3> high = testing::ring(m, 1, height, turn), both = low;
    both.insert(both.end(), high.begin(), high.end());
    const TrianglePatch wall{both, zip_rings(low, high, nullptr), both.size()};
    domain = remesh(wall, onto, {.length_scale = 0.5});
    std::reverse(both.begin() + n, both.end());  // a loop runs as the new faces do
    std::reverse(high.begin(), high.end());
    for (Triangle& t : domain.triangles)
      for (std::int32_t& v : t)
        if (v >= n && v < n + m) v = 2 * n + m - 1 - v;
    std::copy(both.begin(), both.end(), domain.positions.begin());
    loops = {{SourceId(0), true, {}, low, std::vector<std::vector<Vec3>>(low.size())},
             {SourceId(1), false, {}, high, std::vector<std::vector<Vec3>>(high.size())}};
  }
};

}  // namespace skinforge::testing
