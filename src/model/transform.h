#pragma once

#include <cmath>

#include "base/math.h"

namespace skinforge {

/// Translation, rotation and scale of a joint relative to its parent: parent_from_joint = T * R * S.
struct Transform {
  Vec3 translation = Vec3::Zero();
  Quat rotation = Quat::Identity();
  Vec3 scale = Vec3::Ones();

  Affine3 matrix() const {
    Affine3 m;
    m.linear() = rotation.toRotationMatrix() * scale.asDiagonal();
    m.translation() = translation;
    return m;
  }

  template <class Archive>
  friend void fields(Archive& a, Transform& t) {
    a(t.translation, t.rotation, t.scale);
  }
};

/// Rotation, one scale for all axes, translation: p -> scale * R * p + translation. Placements and unit
/// conversions.
struct Similarity {
  double scale = 1;
  Quat rotation = Quat::Identity();
  Vec3 translation = Vec3::Zero();

  Vec3 operator*(const Vec3& p) const { return scale * (rotation * p) + translation; }
  Affine3 matrix() const {
    Affine3 m;
    m.linear() = scale * rotation.toRotationMatrix();
    m.translation() = translation;
    return m;
  }
  bool is_identity() const {
    return scale == 1 && rotation.coeffs() == Quat::Identity().coeffs() && translation.isZero(0);
  }

  template <class Archive>
  friend void fields(Archive& a, Similarity& s) {
    a(s.scale, s.rotation, s.translation);
  }
};

/// `similarity * transform` as TRS again; exact, because a uniform scale commutes with rotations.
inline Transform premultiplied(const Similarity& s, const Transform& t) {
  return {s * t.translation, (s.rotation * t.rotation).normalized(), s.scale * t.scale};
}

}  // namespace skinforge
