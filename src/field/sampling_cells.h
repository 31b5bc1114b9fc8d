#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "field/signed_distance.h"
#include "geometry/triangle_bvh.h"

namespace skinforge {

/// Which side of a surface something is on.
enum class Side : std::uint8_t { Unknown, Outside, Inside };

/// How far from its surface, in voxels, a source needs less than all points: outside of it and inside.
struct SamplingReach {
  double pairs_outside = 6, pairs_inside = 12;   ///< from here on every second point along each axis is asked
  double fours_outside = 16, fours_inside = 20;  ///< and from here on every fourth
};

/// How finely a source needs to be sampled around each cell of a lattice: far from its surface a distance is
/// nearly linear, and the corners of larger cubes tell what lies between.
struct SamplingCells {
  /// The lattice, grown so that cubes of `kCoarsest` cells fill it whose planes lie at multiples of as many
  /// voxels from the model's origin: mirror images of each other are cut into cubes alike.
  Lattice lattice;
  std::array<std::int32_t, 3> first = {0, 0, 0};  ///< point of `lattice` that is the original one's first

  /// A cube of 2^3 cells.
  struct Cube {
    std::int32_t triangle = 0;  ///< near it
    std::uint8_t size = 1;      ///< cells along an edge of the cube that it is asked by: 1, 2 or 4
    Side side = Side::Unknown;  ///< of the whole cube
  };
  std::vector<Cube> cubes;  ///< x fastest; half as many as cells along each axis

  static constexpr std::int32_t kCoarsest = 4;

  std::array<std::int32_t, 3> count() const {
    return {lattice.size[0] / 2, lattice.size[1] / 2, lattice.size[2] / 2};
  }
  const Cube& at(std::int32_t i, std::int32_t j, std::int32_t k) const {
    const auto n = count();
    return cubes[(static_cast<std::size_t>(k) * n[1] + j) * n[0] + i];
  }

  /// One of the cubes around a point of `lattice`.
  const Cube& around(std::int32_t i, std::int32_t j, std::int32_t k) const {
    const auto n = count();
    return at(std::min(i / 2, n[0] - 1), std::min(j / 2, n[1] - 1), std::min(k / 2, n[2] - 1));
  }

  /// What all cubes around a point say of it.
  struct Around {
    std::uint8_t size = kCoarsest;  ///< of the finest
    Side side = Side::Unknown;      ///< the one that is known
  };
  /// The same for the points (i, j, k), (i + 1, j, k) and so on of `lattice`.
  void look_around(std::int32_t i, std::int32_t j, std::int32_t k, std::span<Around> points) const;
};

/// Cuts `lattice`, which must have points, into cubes. Cubes of two cells, and of four, lie wholly as far
/// from the surface as `reach` says: farther inside of it where limbs have an axis at which distances turn
/// around. The side is that of the winding number above 1/2. Same result for any number of threads.
SamplingCells sampling_cells(const Lattice& lattice, const TriangleBvh& bvh, const SamplingReach& reach);

}  // namespace skinforge
