#pragma once

#include <span>
#include <vector>

#include "base/math.h"
#include "model/polygon_mesh.h"
#include "surface/fusion_solid.h"

namespace skinforge {

/// How presence changes over a surface: sums over the triangles where it does.
struct Fading {
  Vec3 axis = Vec3::Zero();  ///< of area * gradient, square metres per metre: towards growing presence
  double slope = 0;          ///< of area * |gradient|: the length of the cut, all levels of presence alike
  double squared = 0;        ///< of area * |gradient|^2

  /// Metres over which presence goes from 0 to 1; 0 where it does not change.
  double width() const { return squared > 0 ? slope / squared : 0; }
};

Fading fading_of(const FusionSolid& solid);

/// The same of a whole mesh. `presence`: #V.
Fading fading_of(const PolygonMesh& mesh, std::span<const double> presence);

/// Angle between the axis along which a host fades, away from what stays of it, and that along which a donor
/// does, towards what stays; radians, 0 when either has none. 0: the donor goes on where the host ends.
double bend_between(const Vec3& host_axis, const Vec3& donor_axis);

/// Length of the line of presence 1/2, metres: how far it is around the cut.
double cut_girth(const FusionSolid& solid);

}  // namespace skinforge
