#include "geometry/scaled_jacobian.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace skinforge {
namespace {

// Of N corners, or of as many as there are when N is 0. Junctions ask this of each place that they try, so a
// side is measured once, and with N known all of it unrolls.
template <std::size_t N>
Vec3 area_normal_of(std::span<const Vec3> polygon) {
  const std::size_t n = N > 0 ? N : polygon.size();
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 1; i + 1 < n; ++i) sum += (polygon[i] - polygon[0]).cross(polygon[i + 1] - polygon[0]);
  return sum;
}

template <std::size_t N>
double least_corner(std::span<const Vec3> polygon) {
  const std::size_t n = N > 0 ? N : polygon.size();
  const Vec3 area = area_normal_of<N>(polygon);
  const double size = area.norm();
  if (!(size > 0)) return -1;
  Vec3 last = polygon[0] - polygon[n - 1];
  double last_length = last.norm(), least = 1;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 side = polygon[i + 1 < n ? i + 1 : 0] - polygon[i];
    const double length = side.norm(), lengths = length * last_length;
    if (!(lengths > 0)) return -1;
    least = std::min(least, last.cross(side).dot(area) / (size * lengths));
    last = side;
    last_length = length;
  }
  return least;
}

}  // namespace

double scaled_jacobian_of_quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return least_corner<4>(std::array{a, b, c, d});
}

double scaled_jacobian_of_triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
  return std::max(least_corner<3>(std::array{a, b, c}), 0.0) * 2 / std::numbers::sqrt3;
}

double scaled_jacobian(std::span<const Vec3> polygon) {
  if (polygon.size() == 3) return scaled_jacobian_of_triangle(polygon[0], polygon[1], polygon[2]);
  return polygon.size() == 4 ? least_corner<4>(polygon) : least_corner<0>(polygon);
}

}  // namespace skinforge
