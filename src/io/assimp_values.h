#pragma once

#include <assimp/matrix4x4.h>
#include <assimp/quaternion.h>
#include <assimp/types.h>

#include <string>

#include "base/math.h"
#include "model/transform.h"

/// Assimp's small values in ours; floats become doubles without change.
namespace skinforge {

inline Vec3 to_vec3(const aiVector3D& v) {
  return {v.x, v.y, v.z};
}
inline Quat to_quat(const aiQuaternion& q) {
  return quaternion_xyzw(q.x, q.y, q.z, q.w);
}
inline std::string to_text(const aiString& s) {
  return {s.data, s.length};
}
inline Affine3 to_affine(const aiMatrix4x4& m) {
  Affine3 a;
  a.matrix() << m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4;
  return a;
}

}  // namespace skinforge
