#pragma once

#include <optional>
#include <span>
#include <vector>

#include "base/id.h"
#include "base/math.h"

namespace skinforge {

/// The plane normal . x = offset that maps a set of points onto itself.
struct MirrorSymmetry {
  Vec3 normal = Vec3::UnitX();  ///< unit length
  double offset = 0;            ///< metres
  std::vector<VertexId>
      partner;  ///< per point its mirror image, an involution: itself on the plane, invalid if it has none
  double matched = 0;  ///< share of points with a partner, in [0, 1]

  Vec3 mirrored(const Vec3& p) const { return p - 2 * (normal.dot(p) - offset) * normal; }
};

struct MirrorOptions {
  double tolerance = 1e-3;  ///< of the diagonal: how far an image may lie from its partner (junction.md d.1)
  double least_share = 0.98;  ///< of the points must have a partner (junction.md d.1)
};

/// The mirror plane of the points (junction.md d.1): first across x, y and z, then across the principal axes;
/// along each normal through the origin, the middle of the box and the centroid. The plane with most matched
/// points wins, the first of equals. None if no plane reaches the share, or for fewer than 2 points or points
/// that all coincide. A partner is the nearest point to the image, both ways; where several points coincide
/// only the lowest pairs. O(n log n).
std::optional<MirrorSymmetry> find_mirror_symmetry(std::span<const Vec3> points,
                                                   const MirrorOptions& options = {});

}  // namespace skinforge
