#pragma once

#include <array>
#include <span>

#include "base/math.h"

namespace skinforge {

/// Quality of a quad, 1 for a rectangle, at most 0 when a corner is not convex: the least over the corners of
/// (e1 x e2).n / (|e1||e2|), e1 and e2 the sides at the corner, n the unit area normal (junction.md c). A
/// side or an area without length gives -1.
double scaled_jacobian_of_quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// Quality of a triangle, 1 when equilateral, 0 when degenerate: 2 / sqrt(3) times its least sine of a
/// corner.
double scaled_jacobian_of_triangle(const Vec3& a, const Vec3& b, const Vec3& c);

/// Either, by the number of positions; a larger polygon: the least sine-like product over its corners as for
/// a quad.
double scaled_jacobian(std::span<const Vec3> polygon);

/// What the scaled Jacobian of a triangle or quad is the least of.
struct CornerJacobians {
  std::array<double, 4>
      corner;   ///< of a triangle the first three; without a side or area -1, or 0 of a triangle
  Vec3 normal;  ///< unit area normal; without area zero
};

/// That, for three or four positions; corners of a triangle are at most 1, as its scaled Jacobian is.
CornerJacobians corner_jacobians(std::span<const Vec3> polygon);

}  // namespace skinforge
