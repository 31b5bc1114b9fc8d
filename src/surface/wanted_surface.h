#pragma once

#include <functional>

#include "base/math.h"

namespace skinforge {

/// Moves a free vertex back onto the wanted surface; returns the new place.
using Projection = std::function<Vec3(const Vec3&)>;

/// Direction away from the solid at a point; need not be unit.
using OutwardDirection = std::function<Vec3(const Vec3&)>;

/// How far a point is off the wanted surface, in voxels.
using OffSurface = std::function<double(const Vec3&)>;

/// The surface that new faces shall lie on.
struct WantedSurface {
  Projection project;
  OutwardDirection outward;
  OffSurface off = [](const Vec3&) { return 0.0; };
};

}  // namespace skinforge
