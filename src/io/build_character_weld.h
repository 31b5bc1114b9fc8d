#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "base/math.h"

namespace skinforge {

/// Finds earlier points at (nearly) the same place. Points nearer than `tolerance` count as one place;
/// 0 means equal coordinates. Deterministic: answers depend on the points and their order only.
class PointIndex {
 public:
  explicit PointIndex(double tolerance) : tolerance_(tolerance), cell_(1024 * tolerance) {}

  void add(std::size_t id, const Vec3& point);
  /// The ids within the tolerance, in the order they were added.
  std::vector<std::size_t> near(const Vec3& point) const;

 private:
  using Cell = std::array<std::int64_t, 3>;
  struct CellHash {
    std::size_t operator()(const Cell& c) const;
  };
  Cell cell_of(const Vec3& point) const;

  double tolerance_;
  double cell_;  ///< edge of a cell, far above the tolerance: nearly every search looks into one cell
  std::unordered_map<Cell, std::vector<std::pair<std::size_t, Vec3>>, CellHash> cells_;  // never iterated
};

}  // namespace skinforge
