#pragma once

#include <cstdint>

#include "base/math.h"

namespace skinforge {

/// How two parts become one surface (junction.md d.2).
enum class BlendOperator : std::uint8_t {
  Auto,      ///< replacement: Paper where the parts are aligned, Gradient where they meet at an angle; union:
             ///< Gradient
  Paper,     ///< Eq. 1 as it stands
  Smin,      ///< a smooth minimum of the trimmed parts: the same fillet everywhere
  Gradient,  ///< the same, with a fillet where surfaces cross and none where they run side by side
};

/// Weight of a presence in a replacement, in [0, 1]: 0 up to 0.001, 1 from 0.999, smoothstep between
/// (junction.md d.2), so that the blended field has no step where a source begins to be fully present.
double presence_weight(double presence);

/// delta_R of Eq. 1 for replacements, metres: the mean of the two distances weighted by presence, with three
/// cases that the formula leaves open, each reached without a step (w = `presence_weight`):
///  - weights are w / (1 - w), so that a source that is wholly present decides alone where the other is not:
///  its preserved
///    surface is met exactly;
///  - where both become wholly present, the nearer surface (a union): two preserved parts must not pull at
///  each other from afar;
///  - where neither is present, the plain mean.
double blend_replace(double distance0, double presence0, double distance1, double presence1);

/// The lesser of two distances, rounded off by a cubic (junction.md d.2): exact where they differ by `radius`
/// (metres, 0 or more) or more, lower by radius / 6 at most. With radius 0 it is Eq. 1 for additions.
double smooth_min(double distance0, double distance1, double radius);
double smooth_max(double distance0, double distance1, double radius);

/// The part of a fillet's radius that is used where two surfaces have unit normals `normal0` and `normal1`:
/// 1 where they meet at a right angle or more sharply, 0.05 where they run side by side, which would only
/// swell (spirit of Gourmel 2013; junction.md d.2).
double fillet_share(const Vec3& normal0, const Vec3& normal1);

}  // namespace skinforge
