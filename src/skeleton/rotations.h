#pragma once

#include "base/math.h"
#include "skeleton/rigid_motion.h"

/// Rotations in all their dresses and the ways between them (ETH Sec. 2; rotations.md compares them). The hub
/// is the unit quaternion; q and -q are one rotation. Angles in radians.
namespace skinforge {

/// Axes of three turns about the axes of the body, one after the other: R = R_first R_second R_third. The
/// same letters backwards are turns about fixed axes, angles backwards too.
enum class EulerOrder : std::uint8_t { XYZ, XZY, YXZ, YZX, ZXY, ZYX, XYX, XZX, YXY, YZY, ZXZ, ZYZ };
inline constexpr int kEulerOrders = 12;

/// Rotation of Euler angles, in the order of their axes.
Quat from_euler(const Vec3& angles, EulerOrder order);

/// Euler angles of a rotation. The first and the third lie in [-pi, pi]; the second in [-pi/2, pi/2] for
/// three different axes, in [0, pi] for proper Euler angles. At the gimbal lock (second at the end of its
/// range within 1e-7), where only a sum of the others is defined, the third is 0. Bernardes and Viollet 2022.
Vec3 to_euler(const Quat& q, EulerOrder order);

/// Exponential map: axis times angle (Grassia 1998). The angle of the result is at most pi; exact through 0.
Vec3 rotation_vector(const Quat& q);
Quat from_rotation_vector(const Vec3& v);

/// The rotation nearest to a matrix in the Frobenius norm (its polar factor; never a reflection).
Mat3 nearest_rotation(const Mat3& m);

/// Rotation and translation as one unit dual quaternion real + dual * epsilon (Kavan 2007, ETH Sec. 1.5):
/// dual = (0, t) * real / 2. `dual` is not unit: a quaternion only by its product.
struct DualQuat {
  Quat real = Quat::Identity();
  Quat dual = Quat(0, 0, 0, 0);
};
DualQuat dual_quaternion(const RigidMotion& motion);
/// Back again; `q` of any length but zero (normalised as in ETH Eq. 4).
RigidMotion rigid_motion(const DualQuat& q);

/// The rigid motion nearest to an affine map: its polar rotation, its translation of `at` (default: the
/// origin). `stretch`, where given, gets the largest difference of a singular value from 1.
RigidMotion nearest_motion(const Affine3& map, const Vec3& at = Vec3::Zero(), double* stretch = nullptr);

}  // namespace skinforge
