#pragma once

#include "model/skeleton.h"

namespace skinforge {

/// A transform of a clip whose last pose only nearly meets its first, moved so that they meet half way: the
/// correction is half of the gap at either end and fades out towards the middle. `first`, `last`: of the same
/// joint at the clip's ends; `place`: 0 = at the first, 1 = at the last.
inline Transform closed(const Transform& t, const Transform& first, const Transform& last, double place) {
  const double share = 0.5 - place;
  const Quat turn = Quat::Identity().slerp(share, last.rotation * first.rotation.conjugate());
  return {t.translation + share * (last.translation - first.translation), (turn * t.rotation).normalized(),
          t.scale + share * (last.scale - first.scale)};
}

}  // namespace skinforge
