#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/math.h"

namespace skinforge {

using TriangleCornerIds = std::array<std::int32_t, 3>;

/// What goes wrong on a surface of several parts in one pose, beyond what is wrong at rest.
struct PosedFaults {
  std::size_t folds = 0;          ///< edges of new surface across which it folds back on itself
  std::size_t intersections = 0;  ///< pairs of triangles that cut each other, see `PosedSurface`
  double stretch = 0;             ///< longest edge of new surface over its length at rest; 0 without any
  std::vector<std::int32_t> triangles;  ///< those that fold or cut, rising
};

/// A surface made of parts, as it is at rest, to be looked at in many poses. Immutable after construction.
class PosedSurface {
 public:
  /// `triangles` and `parts` (one per triangle: the source it was copied from, below 0 for new surface) must
  /// outlive it. Triangles of one source are not compared with each other: what they do is the input's own.
  PosedSurface(std::span<const Vec3> rest, std::span<const TriangleCornerIds> triangles,
               std::span<const std::int32_t> parts);

  /// `positions`: the same vertices, posed. Only where boxes of different parts overlap triangles are
  /// compared. Not for parallel use of one surface with itself changed; any number of calls may run.
  PosedFaults measure(std::span<const Vec3> positions) const;

 private:
  using Pair = std::pair<std::int32_t, std::int32_t>;
  std::vector<Pair> cuts(std::span<const Vec3> positions) const;
  bool folds(std::span<const Vec3> positions, const Pair& neighbours) const;

  std::span<const TriangleCornerIds> triangles_;
  std::span<const std::int32_t> parts_;
  std::vector<Pair> neighbours_;  // of which one is new surface, flat at rest
  std::vector<std::pair<std::array<std::int32_t, 2>, double>> edges_;  // of new surface, with rest lengths
  std::vector<Pair> rest_cuts_;                                        // rising
};

}  // namespace skinforge
