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

// The same, corner by corner, and the normal that they are measured against.
template <std::size_t N>
CornerJacobians corners_of(std::span<const Vec3> polygon) {
  CornerJacobians result{{-1, -1, -1, -1}, area_normal_of<N>(polygon)};
  const double size = result.normal.norm();
  if (!(size > 0)) return result;
  result.normal /= size;
  std::array<Vec3, N> side;
  std::array<double, N> length;
  for (std::size_t i = 0; i < N; ++i) {
    side[i] = polygon[(i + 1) % N] - polygon[i];
    length[i] = side[i].norm();
  }
  if (!(*std::min_element(length.begin(), length.end()) > 0)) return result;
  for (std::size_t i = 0; i < N; ++i) {
    const std::size_t last = (i + N - 1) % N;
    result.corner[i] = side[last].cross(side[i]).dot(result.normal) / (length[last] * length[i]);
  }
  return result;
}

// A triangle's sines in shares of that of 60 degrees.
double share_of_equilateral(double sine) {
  return std::max(sine, 0.0) * 2 / std::numbers::sqrt3;
}

}  // namespace

double scaled_jacobian_of_quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return least_corner<4>(std::array{a, b, c, d});
}

double scaled_jacobian_of_triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
  return share_of_equilateral(least_corner<3>(std::array{a, b, c}));
}

double scaled_jacobian(std::span<const Vec3> polygon) {
  if (polygon.size() == 3) return scaled_jacobian_of_triangle(polygon[0], polygon[1], polygon[2]);
  return polygon.size() == 4 ? least_corner<4>(polygon) : least_corner<0>(polygon);
}

CornerJacobians corner_jacobians(std::span<const Vec3> polygon) {
  if (polygon.size() == 4) return corners_of<4>(polygon);
  CornerJacobians result = corners_of<3>(polygon);
  for (double& corner : result.corner) corner = std::min(share_of_equilateral(corner), 1.0);
  return result;
}

}  // namespace skinforge
