#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/triangle_bvh.h"

namespace skinforge {

/// The cells of a cubic lattice that a surface fills: cells with a piece of a triangle, and cells whose
/// centre is inside by the generalised winding number (> 0.5), so that open, overlapping and many-part
/// surfaces have an inside, too.
class SolidVoxels {
 public:
  /// `resolution`: cells along the longest side of the bounding box, at least 4. Cost: one winding number a
  /// cell of the box, in parallel.
  SolidVoxels(std::span<const Vec3> positions, std::span<const std::array<std::int32_t, 3>> triangles,
              int resolution);

  double size() const { return size_; }                ///< of a cell, metres
  std::size_t count() const { return cells_.size(); }  ///< filled cells
  Vec3 center(std::size_t cell) const;                 ///< of a filled cell
  /// The filled cell nearest to a point (its own where that is filled); -1 when there are none.
  std::int32_t nearest(const Vec3& p) const;

  /// Shortest ways through filled cells (26 neighbours) from the cells that a set of points lies nearest to:
  /// metres, +inf where none leads. Dijkstra, O(n log n).
  std::vector<double> distances_from(std::span<const Vec3> points) const;

 private:
  std::array<int, 3> cell_of(const Vec3& p) const;
  std::int64_t index(const std::array<int, 3>& cell) const;
  void fill(std::span<const Vec3> positions, std::span<const std::array<std::int32_t, 3>> triangles);

  Vec3 origin_ = Vec3::Zero();
  double size_ = 1;
  std::array<int, 3> counts_{};
  std::vector<std::int32_t> filled_;       ///< per lattice cell: number among the filled ones, or -1
  std::vector<std::array<int, 3>> cells_;  ///< filled cells
};

}  // namespace skinforge
