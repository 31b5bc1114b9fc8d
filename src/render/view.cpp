#include "render/view.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace skinforge {
namespace {

constexpr double kNearShare =
    0.02;  // ours: near plane as a share of the distance; closer things would fill the picture

// Least and greatest camera offsets along one picture axis: a point at (a, back) is inside when
// |a - c| <= slope * (d - back) for the eye at (c, d).
struct Extent {
  double low = -std::numeric_limits<double>::infinity();   // max of -a + slope * back
  double high = -std::numeric_limits<double>::infinity();  // max of  a + slope * back

  void add(double a, double back, double slope) {
    low = std::max(low, -a + slope * back);
    high = std::max(high, a + slope * back);
  }
  double center() const { return (high - low) / 2; }
  double distance(double slope) const { return (high + low) / (2 * slope); }
};

}  // namespace

Vec3 ViewAngles::direction() const {
  return {std::sin(yaw) * std::cos(pitch), std::sin(pitch), std::cos(yaw) * std::cos(pitch)};
}

Mat3 View::axes() const {
  const Vec3 back = angles.direction();
  const Vec3 right(std::cos(angles.yaw), 0, -std::sin(angles.yaw));
  Mat3 columns;
  columns << right, back.cross(right), back;
  return columns;
}

View fit_view(std::span<const Vec3> points, const ViewAngles& angles, double aspect, double margin) {
  View view;
  view.angles = angles;
  const Mat3 axes = view.axes();
  const double slope_y = std::tan(view.fov / 2) * (1 - 2 * margin), slope_x = slope_y * aspect;
  Extent x, y;
  double foremost = -std::numeric_limits<double>::infinity();
  for (const Vec3& p : points) {
    const Vec3 q = axes.transpose() * p;
    x.add(q.x(), q.z(), slope_x);
    y.add(q.y(), q.z(), slope_y);
    foremost = std::max(foremost, q.z());
  }
  if (points.empty()) return fit_view(Vec3::Zero(), 0, angles, aspect, margin);
  const double distance = std::max(x.distance(slope_x), y.distance(slope_y));
  if (!(distance > foremost)) return fit_view(points[0], 0, angles, aspect, margin);
  view.eye = axes * Vec3(x.center(), y.center(), distance);
  view.near = kNearShare * (distance - foremost);
  return view;
}

View fit_view(const Vec3& center, double radius, const ViewAngles& angles, double aspect, double margin) {
  View view;
  view.angles = angles;
  const double slope = std::tan(view.fov / 2) * (1 - 2 * margin) * std::min(aspect, 1.0);
  const double distance = radius > 0 ? radius * std::sqrt(1 + slope * slope) / slope : 1.0;
  view.eye = center + distance * angles.direction();
  view.near = kNearShare * distance;
  return view;
}

}  // namespace skinforge
