#pragma once

#include <optional>
#include <span>
#include <vector>

#include "base/archive.h"
#include "base/id.h"
#include "base/math.h"

namespace skinforge {

/// The plane normal . x = offset. Where the normal is an axis and the offset 0, mirroring is exact to the
/// last bit.
struct MirrorPlane {
  Vec3 normal = Vec3::UnitX();  ///< unit length
  double offset = 0;            ///< metres

  double height(const Vec3& p) const { return normal.dot(p) - offset; }  ///< above the plane
  Vec3 onto(const Vec3& p) const { return p - height(p) * normal; }
  Vec3 mirrored(const Vec3& p) const { return p - 2 * height(p) * normal; }
  Vec3 mirrored_direction(const Vec3& d) const { return d - 2 * normal.dot(d) * normal; }

  template <class Archive>
  friend void fields(Archive& a, MirrorPlane& p) {
    a(p.normal, p.offset);
  }
};

/// The plane that maps a set of points onto itself.
struct MirrorSymmetry {
  MirrorPlane plane;
  std::vector<VertexId>
      partner;  ///< per point its mirror image, an involution: itself on the plane, invalid if it has none
  double matched = 0;  ///< share of points with a partner, in [0, 1]
};

struct MirrorOptions {
  double tolerance = 1e-3;  ///< of the diagonal: how far an image may lie from its partner (junction.md d.1)
  double least_share = 0.98;  ///< of the points must have a partner (junction.md d.1)
};

/// The mirror plane of the points (junction.md d.1): first across x, y and z, then across the principal axes;
/// along each normal through the origin, the middle of the box and the centroid. The plane with most matched
/// points wins, the first of equals; then it moves to the median of the points halfway between partners, so
/// that points without one do not pull it aside, and through the origin where it all but runs there. None if
/// no plane reaches the share, or for fewer than 2 points or points that all coincide. A partner is the
/// nearest point to the image, both ways; where several points coincide only the lowest pairs. O(n log n).
std::optional<MirrorSymmetry> find_mirror_symmetry(std::span<const Vec3> points,
                                                   const MirrorOptions& options = {});

/// Per point of `from` its mirror image in `to`: the nearest within `reach` (metres), if that one's nearest
/// is the point again; else invalid. O(n log n).
std::vector<VertexId> mirror_partners(std::span<const Vec3> from, std::span<const Vec3> to,
                                      const MirrorPlane& plane, double reach);

}  // namespace skinforge
