#pragma once

#include <span>

#include "base/math.h"

namespace skinforge {

/// Where the eye stands, seen from what it looks at. Yaw 0 sees the front of a character (from +Z); growing
/// yaw walks counter-clockwise seen from above (90 degrees: from +X); growing pitch climbs. Radians.
struct ViewAngles {
  double yaw = 0;
  double pitch = 0;

  /// Unit vector towards the eye, model space.
  Vec3 direction() const;
};

/// A pinhole camera in model space, metres.
struct View {
  Vec3 eye = Vec3(0, 0, 5);
  ViewAngles angles = {};
  double fov = radians(26);  ///< vertical opening, radians; ours: a portrait lens, little distortion
  double near = 1e-3;        ///< metres before the eye; what is nearer is not drawn

  /// Columns: right, up, back (towards the eye), all unit vectors of model space.
  Mat3 axes() const;
};

/// The nearest eye from which all `points` lie inside a picture of `aspect` (width / height), with `margin`
/// of the picture free on each side, in [0, 0.4]. No points, or points in one place: a view from 1 m. Linear.
View fit_view(std::span<const Vec3> points, const ViewAngles& angles, double aspect = 1,
              double margin = 0.06);

/// The same for a ball.
View fit_view(const Vec3& center, double radius, const ViewAngles& angles, double aspect = 1,
              double margin = 0.06);

}  // namespace skinforge
