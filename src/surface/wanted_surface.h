#pragma once

#include <functional>
#include <limits>

#include "base/math.h"

namespace skinforge {

/// Moves a free vertex back onto the wanted surface; returns the new place.
using Projection = std::function<Vec3(const Vec3&)>;

/// Direction away from the solid at a point; need not be unit.
using OutwardDirection = std::function<Vec3(const Vec3&)>;

/// Distance of a point to the wanted surface, positive outside, metres.
using SurfaceDistance = std::function<double(const Vec3&)>;

/// The surface that new faces shall lie on.
struct WantedSurface {
  Projection project;
  OutwardDirection outward;  ///< the gradient of `distance`, where that matters
  SurfaceDistance distance = [](const Vec3&) { return 0.0; };
  double voxel = std::numeric_limits<double>::infinity();  ///< metres; infinite: distances do not matter
};

}  // namespace skinforge
