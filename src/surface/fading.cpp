#include "surface/fading.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace skinforge {
namespace {

// `d1`, `d2`: presence of the second and third corner less that of the first.
void add_triangle(Fading& sum, const std::array<Vec3, 3>& corners, double d1, double d2) {
  const Vec3 e1 = corners[1] - corners[0], e2 = corners[2] - corners[0];
  const Vec3 cross = e1.cross(e2);
  if (!(cross.squaredNorm() > 0)) return;
  const Vec3 gradient = (d1 * e2 - d2 * e1).cross(cross) / cross.squaredNorm();
  const double area = 0.5 * cross.norm();
  sum.axis += area * gradient;
  sum.slope += area * gradient.norm();
  sum.squared += area * gradient.squaredNorm();
}

}  // namespace

Fading fading_of(const FusionSolid& solid) {
  Fading sum;
  for (const auto& [a, b, c] : solid.triangles)
    add_triangle(sum, {solid.positions[a], solid.positions[b], solid.positions[c]},
                 solid.presence[b] - solid.presence[a], solid.presence[c] - solid.presence[a]);
  return sum;
}

Fading fading_of(const PolygonMesh& mesh, std::span<const double> presence) {
  Fading sum;
  for (const auto& [va, vb, vc] : triangulate(mesh).triangles) {
    const std::size_t a = va.index(), b = vb.index(), c = vc.index();
    if (presence[a] == presence[b] && presence[a] == presence[c]) continue;
    add_triangle(sum, {mesh.positions[a], mesh.positions[b], mesh.positions[c]}, presence[b] - presence[a],
                 presence[c] - presence[a]);
  }
  return sum;
}

double bend_between(const Vec3& host_axis, const Vec3& donor_axis) {
  if (!(host_axis.norm() > 0) || !(donor_axis.norm() > 0)) return 0;
  return std::acos(std::clamp(-host_axis.normalized().dot(donor_axis.normalized()), -1.0, 1.0));
}

double cut_girth(const FusionSolid& solid) {
  double length = 0;
  for (const Triangle& t : solid.triangles) {
    std::array<Vec3, 3> crossing;
    int found = 0;
    for (int k = 0; k < 3; ++k) {
      const double a = solid.presence[t[k]] - 0.5, b = solid.presence[t[(k + 1) % 3]] - 0.5;
      if ((a < 0) == (b < 0)) continue;
      crossing[found++] =
          solid.positions[t[k]] + a / (a - b) * (solid.positions[t[(k + 1) % 3]] - solid.positions[t[k]]);
    }
    if (found == 2) length += (crossing[1] - crossing[0]).norm();
  }
  return length;
}

}  // namespace skinforge
