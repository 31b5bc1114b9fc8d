#include "geometry/scaled_jacobian.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace skinforge {
namespace {

Vec3 area_normal_of(std::span<const Vec3> polygon) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    sum += (polygon[i] - polygon[0]).cross(polygon[i + 1] - polygon[0]);
  return sum;
}

double least_corner(std::span<const Vec3> polygon) {
  const Vec3 area = area_normal_of(polygon);
  const double size = area.norm();
  if (!(size > 0)) return -1;
  double least = 1;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 e1 = polygon[(i + 1) % polygon.size()] - polygon[i];
    const Vec3 e2 = polygon[(i + polygon.size() - 1) % polygon.size()] - polygon[i];
    const double lengths = e1.norm() * e2.norm();
    if (!(lengths > 0)) return -1;
    least = std::min(least, e1.cross(e2).dot(area) / (size * lengths));
  }
  return least;
}

}  // namespace

double scaled_jacobian_of_quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return least_corner(std::array{a, b, c, d});
}

double scaled_jacobian_of_triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
  return std::max(least_corner(std::array{a, b, c}), 0.0) * 2 / std::numbers::sqrt3;
}

double scaled_jacobian(std::span<const Vec3> polygon) {
  if (polygon.size() == 3) return scaled_jacobian_of_triangle(polygon[0], polygon[1], polygon[2]);
  return least_corner(polygon);
}

}  // namespace skinforge
