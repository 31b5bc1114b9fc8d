#pragma once

#include <span>
#include <vector>

#include "base/id.h"
#include "base/math.h"

namespace skinforge {

/// Nearest point of a set, by a balanced k-d tree. Points may coincide. Immutable after construction, so
/// queries may run in parallel.
class PointTree {
 public:
  /// Refers to `points`, which must outlive it. O(n log n).
  explicit PointTree(std::span<const Vec3> points);

  /// The nearest within `limit` (metres), of equals the lowest; invalid if there is none. About O(log n).
  VertexId nearest(const Vec3& p, double limit) const;
  std::span<const Vec3> points() const { return points_; }

 private:
  struct Best {
    double distance2;
    VertexId point;
  };
  void build(std::size_t begin, std::size_t end);
  void search(std::size_t begin, std::size_t end, const Vec3& p, Best& best) const;

  std::span<const Vec3> points_;
  std::vector<VertexId> order_;      // of each range the middle one splits the others
  std::vector<unsigned char> axis_;  // along which, by the place in `order_`
};

}  // namespace skinforge
