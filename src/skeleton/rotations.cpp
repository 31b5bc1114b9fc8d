#include "skeleton/rotations.h"

#include <Eigen/SVD>
#include <array>
#include <cmath>

namespace skinforge {
namespace {

constexpr double kGimbal = 1e-7;  // ours: radians; half the digits of a double

constexpr std::array<std::array<int, 3>, kEulerOrders> kAxes{{{0, 1, 2},
                                                              {0, 2, 1},
                                                              {1, 0, 2},
                                                              {1, 2, 0},
                                                              {2, 0, 1},
                                                              {2, 1, 0},
                                                              {0, 1, 0},
                                                              {0, 2, 0},
                                                              {1, 0, 1},
                                                              {1, 2, 1},
                                                              {2, 0, 2},
                                                              {2, 1, 2}}};

double wrapped(double angle) {
  return std::remainder(angle, 2 * std::numbers::pi);
}

}  // namespace

Quat from_euler(const Vec3& angles, EulerOrder order) {
  Quat q = Quat::Identity();
  for (int i = 0; i < 3; ++i)
    q = q * Quat(Eigen::AngleAxisd(angles[i], Vec3::Unit(kAxes[static_cast<std::size_t>(order)][i])));
  return q;
}

Vec3 to_euler(const Quat& q, EulerOrder order) {
  // The formulas are for turns about fixed axes, so the axes are read backwards.
  const auto& axes = kAxes[static_cast<std::size_t>(order)];
  const int i = axes[2], j = axes[1];
  const bool is_proper = axes[0] == axes[2];
  const int k = is_proper ? 3 - i - j : axes[0];
  const double sign = (i - j) * (j - k) * (k - i) / 2;
  const Vec4 c = q.coeffs();  // x, y, z, w
  const Vec4 r = is_proper ? Vec4(c[3], c[i], c[j], sign * c[k])
                           : Vec4(c[3] - c[j], c[i] + sign * c[k], c[j] + c[3], sign * c[k] - c[i]);
  const double second = 2 * std::atan2(std::hypot(r[2], r[3]), std::hypot(r[0], r[1]));
  const double half_sum = std::atan2(r[1], r[0]), half_difference = std::atan2(r[3], r[2]);
  double first = half_sum + half_difference, third = half_sum - half_difference;
  if (second < kGimbal) {
    first = 2 * half_sum;
    third = 0;
  } else if (std::numbers::pi - second < kGimbal) {
    first = 2 * half_difference;
    third = 0;
  }
  if (is_proper) return {wrapped(first), second, wrapped(third)};
  return {wrapped(sign * first), second - std::numbers::pi / 2, wrapped(third)};
}

Vec3 rotation_vector(const Quat& q) {
  const Vec3 v = q.w() < 0 ? Vec3(-q.vec()) : Vec3(q.vec());
  const double sine = v.norm();
  if (sine < 1e-8) return 2 * v;  // sin x = x to the last bit of 2 x
  return 2 * std::atan2(sine, std::abs(q.w())) / sine * v;
}

Quat from_rotation_vector(const Vec3& v) {
  const double half = v.norm() / 2;
  const double factor = half < 1e-8 ? 0.5 : std::sin(half) / (2 * half);
  const Vec3 vec = factor * v;
  return Quat(std::cos(half), vec.x(), vec.y(), vec.z());
}

Mat3 nearest_rotation(const Mat3& m) {
  const Eigen::JacobiSVD<Mat3> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Mat3 u = svd.matrixU();
  if ((u * svd.matrixV().transpose()).determinant() < 0) u.col(2) *= -1;
  return u * svd.matrixV().transpose();
}

DualQuat dual_quaternion(const RigidMotion& motion) {
  const Quat t(0, motion.translation.x(), motion.translation.y(), motion.translation.z());
  return {motion.rotation, Quat(0.5 * (t * motion.rotation).coeffs())};
}

RigidMotion rigid_motion(const DualQuat& q) {
  const double length = q.real.norm();
  const Quat real(q.real.coeffs() / length), dual(q.dual.coeffs() / length);
  return {real, 2 * (dual * real.conjugate()).vec()};
}

RigidMotion nearest_motion(const Affine3& map, const Vec3& at, double* stretch) {
  const Mat3 rotation = nearest_rotation(map.linear());
  if (stretch) {
    const Vec3 sizes = Eigen::JacobiSVD<Mat3>(map.linear()).singularValues();
    *stretch = (sizes.array() - 1).abs().maxCoeff();
  }
  RigidMotion motion{Quat(rotation), Vec3::Zero()};
  motion.translation = map * at - motion.rotation * at;
  return motion;
}

}  // namespace skinforge
