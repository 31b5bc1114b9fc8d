#pragma once

#include <cstdint>
#include <vector>

#include "field/signed_distance.h"
#include "geometry/triangle_bvh.h"

namespace skinforge {

/// Which side of a surface something is on.
enum class Side : std::uint8_t { Unknown, Outside, Inside };

/// How finely a source needs to be sampled around each cell of a lattice: far from its surface a distance is
/// nearly linear, and the corners of larger cubes tell what lies between.
struct SamplingCells {
  /// The lattice, grown so that cubes of `kCoarsest` cells fill it whose planes lie at multiples of as many
  /// voxels from the model's origin: mirror images of each other are cut into cubes alike.
  Lattice lattice;
  std::array<std::int32_t, 3> first = {0, 0, 0};  ///< point of `lattice` that is the original one's first

  /// Per cell (one less than points along each axis, x fastest).
  struct Cell {
    std::int32_t triangle = 0;  ///< near it
    std::uint8_t size = 1;      ///< cells along an edge of the cube that it belongs to: 1, 2 or 4
    Side side = Side::Unknown;  ///< of the whole cube
  };
  std::vector<Cell> cells;

  static constexpr std::int32_t kCoarsest = 4;

  std::array<std::int32_t, 3> count() const {
    return {lattice.size[0] - 1, lattice.size[1] - 1, lattice.size[2] - 1};
  }
  const Cell& at(std::int32_t i, std::int32_t j, std::int32_t k) const {
    const auto n = count();
    return cells[(static_cast<std::size_t>(k) * n[1] + j) * n[0] + i];
  }
  /// Of the cells around a point one of the finest.
  const Cell& finest_around(std::int32_t i, std::int32_t j, std::int32_t k) const;
};

/// Cuts `lattice`, which must have points, into cubes. Outside of the surface cubes of two cells are at least
/// 6 voxels away from it, of four 16; inside 12 and 20, because limbs have an axis where distances turn
/// around. The side is that of the winding number above 1/2. Same result for any number of threads.
SamplingCells sampling_cells(const Lattice& lattice, const TriangleBvh& bvh);

}  // namespace skinforge
