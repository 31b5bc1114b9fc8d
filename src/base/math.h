#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <numbers>

namespace skinforge {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
using Vec4 = Eigen::Vector4d;
using Mat3 = Eigen::Matrix3d;
using Quat = Eigen::Quaterniond;
/// 3x4 affine map. Named by both ends, result first: `model_from_joint`.
using Affine3 = Eigen::Transform<double, 3, Eigen::AffineCompact>;

/// The one way to build a quaternion from four numbers: files store x, y, z, w, Eigen's constructor takes w
/// first.
inline Quat quaternion_xyzw(double x, double y, double z, double w) {
  return Quat(w, x, y, z);
}

inline double radians(double degrees) {
  return degrees * std::numbers::pi / 180.0;
}
inline double degrees(double radians) {
  return radians * 180.0 / std::numbers::pi;
}

}  // namespace skinforge
