#pragma once

#include <array>
#include <optional>
#include <span>

#include "base/math.h"

namespace skinforge {

/// Corners of one triangle, counter-clockwise from outside.
using TriangleCorners = std::array<Vec3, 3>;

/// Whether the corners lie on a line to within a sine of 1e-10 (or coincide): such a triangle has no usable
/// plane.
bool is_degenerate(const TriangleCorners& t);

/// Barycentric coordinates of the point of the triangle nearest to `p`: each in [0, 1], sum 1. The region
/// walk of Ericson, Real-Time Collision Detection, Sec. 5.1.5; for a degenerate triangle the nearest of its
/// three edges, so the answer is always finite.
Vec3 closest_barycentric(const Vec3& p, const TriangleCorners& t);

/// The same for a triangle known not to be degenerate, where the test would cost more than the answer.
Vec3 closest_barycentric_in_plane(const Vec3& p, const TriangleCorners& t);

/// The point with those barycentric coordinates; exactly a corner when its coordinate is 1.
Vec3 interpolate(const TriangleCorners& t, const Vec3& barycentric);

/// Sum of the signed solid angles of triangles seen from `p`, each in (-2 pi, 2 pi): positive when `p` is
/// behind a triangle (inside of an outward-oriented surface), 0 in its plane. Van Oosterom and Strackee 1983;
/// the half angles are added as arguments of complex numbers, so that all share one arc tangent.
double solid_angle(const Vec3& p, std::span<const TriangleCorners> triangles);

/// Parameter t >= 0 at which origin + t * direction meets the triangle from either side; none if it misses,
/// if the ray runs in the plane or if the triangle has no area. Moeller and Trumbore 1997.
std::optional<double> ray_parameter(const Vec3& origin, const Vec3& direction, const TriangleCorners& t);

}  // namespace skinforge
