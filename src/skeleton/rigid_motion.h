#pragma once

#include "base/math.h"

namespace skinforge {

/// p -> rotation * p + translation. In deformation: how a bone stands with respect to its rest pose, in model
/// space (R_k and T_k of ETH Sec. 3).
struct RigidMotion {
  Quat rotation = Quat::Identity();  ///< unit
  Vec3 translation = Vec3::Zero();   ///< metres

  Vec3 operator*(const Vec3& p) const { return rotation * p + translation; }
  Affine3 matrix() const {
    Affine3 m;
    m.linear() = rotation.toRotationMatrix();
    m.translation() = translation;
    return m;
  }
};

/// `first` is applied before `second`.
inline RigidMotion after(const RigidMotion& second, const RigidMotion& first) {
  return {second.rotation * first.rotation, second * first.translation};
}

inline RigidMotion inverse(const RigidMotion& m) {
  const Quat back = m.rotation.conjugate();
  return {back, -(back * m.translation)};
}

}  // namespace skinforge
