#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "base/math.h"

namespace skinforge {

/// Answer of a closest-point query.
struct ClosestPoint {
  std::int32_t triangle = -1;  ///< index into the triangles given; -1 when nothing lies within the limit
  Vec3 barycentric = Vec3::Zero();
  Vec3 point = Vec3::Zero();
  double distance = 0;
};

/// Hit of a ray.
struct RayHit {
  std::int32_t triangle = -1;
  double distance = 0;
};

/// One hierarchy over a triangle soup for closest points, generalised winding numbers and rays. Immutable
/// after construction, so queries may run in parallel. The soup may be open, non-manifold or overlapping;
/// degenerate triangles are kept (closest point works on them, they add nothing to the winding number). Equal
/// inputs give equal bits. Building costs O(n log n), a query about O(log n).
class TriangleBvh {
 public:
  /// `triangles`: corner indices into `positions`. Both are copied. Empty is allowed: nothing is ever found.
  TriangleBvh(std::span<const Vec3> positions, std::span<const std::array<std::int32_t, 3>> triangles);
  ~TriangleBvh();
  TriangleBvh(TriangleBvh&&) noexcept;
  TriangleBvh& operator=(TriangleBvh&&) noexcept;

  /// Nearest point within `limit` (metres). Ties go to the lowest triangle index.
  ClosestPoint closest(const Vec3& query, double limit = 1e300) const;

  /// The same without a limit, faster where `hint` (a valid triangle) is near the answer. The hint does not
  /// change it.
  ClosestPoint closest_from_hint(const Vec3& query, std::int32_t hint) const;

  /// Generalised winding number (Jacobson 2013) by the hierarchy of Barill 2018 (dipole expansion of order 2,
  /// accuracy parameter 2): about 1 inside a closed outward-oriented surface, 0 outside, in between near
  /// holes.
  double winding_number(const Vec3& query) const;

  /// First triangle hit by origin + t * direction, t in (0, limit). `direction` need not be unit; distance is
  /// t.
  RayHit first_hit(const Vec3& origin, const Vec3& direction, double limit = 1e300) const;

  /// Indices of all triangles whose bounding boxes overlap the box [low, high], rising.
  std::vector<std::int32_t> overlapping(const Vec3& low, const Vec3& high) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace skinforge
