#pragma once

#include "base/math.h"

namespace skinforge::testing {

constexpr double kVisibleTurn =
    1e-3;  // ours: radians; a joint's far end moves by less than a pixel in pictures
constexpr double kVisibleMove = 1e-4;  // ours: of the character's diagonal

inline bool turns_visibly(const Quat& a, const Quat& b) {
  return a.normalized().angularDistance(b.normalized()) > kVisibleTurn;
}

inline bool moves_visibly(const Vec3& a, const Vec3& b, double diagonal) {
  return (a - b).norm() > kVisibleMove * diagonal;
}

}  // namespace skinforge::testing
