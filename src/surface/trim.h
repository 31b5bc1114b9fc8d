#pragma once

#include <span>

#include "field/signed_distance.h"
#include "surface/triangle_patch.h"

namespace skinforge {

/// The part of a surface where `value` is positive, cut along value = 0 by splitting triangles (marching). A
/// cut stays a tenth of the edge away from its ends, so that no slivers appear. New vertices lie on their
/// edges. No vertex of the result is fixed.
TrianglePatch trim_positive(const IsoSurface& surface, std::span<const double> value);

}  // namespace skinforge
