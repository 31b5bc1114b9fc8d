#include "geometry/triangle_math.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace skinforge {
namespace {

constexpr double kDegenerateSine = 1e-10;  // ours: below it rounding of the cross product decides the plane

// Parameter in [0, 1] of the point of segment a-b nearest to p; 0 for a segment without length.
double closest_on_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const double length2 = (b - a).squaredNorm();
  return length2 > 0 ? std::clamp((p - a).dot(b - a) / length2, 0.0, 1.0) : 0.0;
}

Vec3 closest_on_edges(const Vec3& p, const TriangleCorners& t) {
  Vec3 best = Vec3::UnitX();
  double best_distance2 = (p - t[0]).squaredNorm();
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const double s = closest_on_segment(p, t[i], t[j]);
    const double distance2 = (p - (t[i] + s * (t[j] - t[i]))).squaredNorm();
    if (distance2 >= best_distance2) continue;
    best_distance2 = distance2;
    best = (1 - s) * Vec3::Unit(i) + s * Vec3::Unit(j);
  }
  return best;
}

// Sum of angles in (-pi, pi), each given by a vector, as the angle of one vector and a number of whole turns.
class HalfAngleSum {
 public:
  void add(double cosine, double sine) {
    const double x = x_ * cosine - y_ * sine, y = x_ * sine + y_ * cosine;
    if (sine > 0 && y_ >= 0 && y < 0) ++turns_;
    if (sine < 0 && y_ < 0 && y >= 0) --turns_;
    x_ = x;
    y_ = y;
  }
  double angle() const { return std::atan2(y_, x_) + 2 * std::numbers::pi * turns_; }

 private:
  double x_ = 1, y_ = 0;
  int turns_ = 0;
};

}  // namespace

bool is_degenerate(const TriangleCorners& t) {
  const Vec3 ab = t[1] - t[0], ac = t[2] - t[0], bc = t[2] - t[1];
  const double longest2 = std::max({ab.squaredNorm(), ac.squaredNorm(), bc.squaredNorm()});
  const double least = kDegenerateSine * longest2;
  return !(ab.cross(ac).squaredNorm() > least * least);
}

Vec3 closest_barycentric(const Vec3& p, const TriangleCorners& t) {
  return is_degenerate(t) ? closest_on_edges(p, t) : closest_barycentric_in_plane(p, t);
}

Vec3 closest_barycentric_in_plane(const Vec3& p, const TriangleCorners& t) {
  const Vec3 ab = t[1] - t[0], ac = t[2] - t[0];
  const Vec3 ap = p - t[0], bp = p - t[1], cp = p - t[2];
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return Vec3::UnitX();
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return Vec3::UnitY();
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return Vec3::UnitZ();
  const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) {
    const double s = d1 / (d1 - d3);
    return {1 - s, s, 0};
  }
  if (vb <= 0 && d2 >= 0 && d6 <= 0) {
    const double s = d2 / (d2 - d6);
    return {1 - s, 0, s};
  }
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double s = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0, 1 - s, s};
  }
  const double sum = va + vb + vc;
  return sum > 0 ? Vec3(va / sum, vb / sum, vc / sum) : closest_on_edges(p, t);
}

Vec3 interpolate(const TriangleCorners& t, const Vec3& barycentric) {
  return barycentric[0] * t[0] + barycentric[1] * t[1] + barycentric[2] * t[2];
}

double solid_angle(const Vec3& p, std::span<const TriangleCorners> triangles) {
  HalfAngleSum sum;
  for (const TriangleCorners& t : triangles) {
    const Vec3 a = t[0] - p, b = t[1] - p, c = t[2] - p;
    const double volume = a.dot(b.cross(c));
    if (volume == 0) continue;
    const double la = a.norm(), lb = b.norm(), lc = c.norm(), product = la * lb * lc;
    sum.add((product + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb) / product, volume / product);
  }
  return 2 * sum.angle();
}

std::optional<double> ray_parameter(const Vec3& origin, const Vec3& direction, const TriangleCorners& t) {
  const Vec3 ab = t[1] - t[0], ac = t[2] - t[0];
  const Vec3 h = direction.cross(ac);
  const double determinant = ab.dot(h);
  if (determinant == 0) return std::nullopt;
  const Vec3 s = origin - t[0];
  const double u = s.dot(h) / determinant;
  const Vec3 q = s.cross(ab);
  const double v = direction.dot(q) / determinant;
  if (!(u >= 0 && v >= 0 && u + v <= 1)) return std::nullopt;
  const double parameter = ac.dot(q) / determinant;
  return parameter >= 0 ? std::optional(parameter) : std::nullopt;
}

}  // namespace skinforge
