#include "geometry/winding_expansion.h"

#include <cmath>
#include <limits>

namespace skinforge {
namespace {

using Linear = WindingMoments::Linear;
using Quadratic = WindingMoments::Quadratic;
using Cubic = WindingMoments::Cubic;

constexpr double kAccuracy =
    2;  // Barill 2018, Sec. 4: the distance over the radius from which a cluster is far

Quadratic product(const Linear& a, const Linear& b) {
  Quadratic q;
  q << a[0] * b[0], a[1] * b[1], a[2] * b[2], a[1] * b[2] + a[2] * b[1], a[0] * b[2] + a[2] * b[0],
      a[0] * b[1] + a[1] * b[0];
  return q;
}

Cubic product(const Linear& a, const Quadratic& q) {
  Cubic c;
  c << a[0] * q[0], a[1] * q[1], a[2] * q[2],   // xxx yyy zzz
      a[0] * q[5] + a[1] * q[0],                // xxy
      a[0] * q[4] + a[2] * q[0],                // xxz
      a[0] * q[1] + a[1] * q[5],                // xyy
      a[1] * q[3] + a[2] * q[1],                // yyz
      a[0] * q[2] + a[2] * q[4],                // xzz
      a[1] * q[2] + a[2] * q[3],                // yzz
      a[0] * q[3] + a[1] * q[4] + a[2] * q[5];  // xyz
  return c;
}

// A multiple of |r|^2 adds nothing but lower orders to a harmonic function: take it out of the quadratic ...
Quadratic without_trace(Quadratic q) {
  const double trace = q[0] + q[1] + q[2];
  q.head<3>().array() -= trace / 3;
  return q;
}

// ... and the multiple (v.r)|r|^2 out of the cubic, v = its Laplacian / 10.
Cubic without_trace(const Cubic& c) {
  const Vec3 laplacian(6 * c[0] + 2 * c[5] + 2 * c[7], 6 * c[1] + 2 * c[3] + 2 * c[8],
                       6 * c[2] + 2 * c[4] + 2 * c[6]);
  Quadratic squared_norm;
  squared_norm << 1, 1, 1, 0, 0, 0;
  return c - product(Linear(laplacian / 10), squared_norm);
}

}  // namespace

WindingMoments WindingMoments::of(const TriangleCorners& t) {
  WindingMoments m;
  m.centre = (t[0] + t[1] + t[2]) / 3;
  if (is_degenerate(t)) return m;
  m.order0 = (t[1] - t[0]).cross(t[2] - t[0]) / 2;
  m.area = m.order0.norm();
  // The mean of (d.r)^2 is the sum over the corners / 12; the first moment about the centroid vanishes.
  Quadratic mean = Quadratic::Zero();
  for (const Vec3& corner : t) {
    const Vec3 d = corner - m.centre;
    mean += product(d, d) / 12;
  }
  m.order2 = product(m.order0, mean);
  return m;
}

WindingMoments WindingMoments::about(const Vec3& new_centre) const {
  const Linear shift = centre - new_centre;
  WindingMoments m = *this;
  m.centre = new_centre;
  m.order1 += product(order0, shift);
  m.order2 += 2 * product(shift, order1) + product(order0, product(shift, shift));
  return m;
}

WindingMoments WindingMoments::sum(std::span<const WindingMoments> parts) {
  WindingMoments total;
  if (parts.empty()) return total;
  for (const WindingMoments& part : parts) {
    total.area += part.area;
    total.centre += part.area * part.centre;
  }
  total.centre = total.area > 0 ? Vec3(total.centre / total.area) : parts.front().centre;
  for (const WindingMoments& part : parts) {
    const WindingMoments moved = part.about(total.centre);
    total.order0 += moved.order0;
    total.order1 += moved.order1;
    total.order2 += moved.order2;
  }
  return total;
}

WindingExpansion::WindingExpansion() : far2(Lanes::Constant(std::numeric_limits<double>::infinity())) {
  for (Lanes& lanes : centre) lanes.setZero();
  for (Lanes& lanes : order0) lanes.setZero();
  for (Lanes& lanes : order1) lanes.setZero();
  for (Lanes& lanes : order2) lanes.setZero();
}

void WindingExpansion::set(int lane, const WindingMoments& moments, double radius) {
  const Quadratic quadratic = 3 * without_trace(moments.order1);
  const Cubic cubic = 7.5 * without_trace(moments.order2);
  for (int i = 0; i < 3; ++i) centre[i][lane] = moments.centre[i];
  for (int i = 0; i < 3; ++i) order0[i][lane] = moments.order0[i];
  for (int i = 0; i < 6; ++i) order1[i][lane] = quadratic[i];
  for (int i = 0; i < 10; ++i) order2[i][lane] = cubic[i];
  far2[lane] = kAccuracy * kAccuracy * radius * radius;
}

// With r = p - q the winding density is the gradient of -1/|r|; its Taylor series about p, contracted with
// the moments, leaves  n.r/|r|^3 - 3 Q(r)/|r|^5 + 15/2 C(r)/|r|^7  for trace-free Q and C.
WindingExpansion::Value WindingExpansion::at(const Vec3& query) const {
  const Lanes x = centre[0] - query[0], y = centre[1] - query[1], z = centre[2] - query[2];
  const Lanes xx = x * x, yy = y * y, zz = z * z, xy = x * y, xz = x * z, yz = y * z;
  const Lanes distance2 = xx + yy + zz;
  // One product a statement: longer expressions are not inlined and cost twice the time.
  Lanes linear = order0[0] * x;
  linear += order0[1] * y;
  linear += order0[2] * z;
  Lanes quadratic = order1[0] * xx;
  quadratic += order1[1] * yy;
  quadratic += order1[2] * zz;
  quadratic += order1[3] * yz;
  quadratic += order1[4] * xz;
  quadratic += order1[5] * xy;
  Lanes along_x = order2[0] * x, along_y = order2[1] * y, along_z = order2[2] * z;
  along_x += order2[3] * y;
  along_x += order2[4] * z;
  along_y += order2[5] * x;
  along_y += order2[6] * z;
  along_z += order2[7] * x;
  along_z += order2[8] * y;
  Lanes cubic = along_x * xx;
  cubic += along_y * yy;
  cubic += along_z * zz;
  cubic += order2[9] * xy * z;
  const Lanes inverse2 = distance2.inverse();
  const Lanes inverse3 = inverse2 * inverse2.sqrt();
  return {(linear - (quadratic - cubic * inverse2) * inverse2) * inverse3, distance2};
}

}  // namespace skinforge
