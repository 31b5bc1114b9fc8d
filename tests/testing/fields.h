#pragma once

#include <functional>

#include "field/signed_distance.h"

namespace skinforge::testing {

/// The values of a function at the points of a lattice.
inline DistanceField sampled(const Lattice& lattice, const std::function<double(const Vec3&)>& f) {
  DistanceField field{.lattice = lattice, .values = {}};
  field.values.reserve(lattice.count());
  for (int k = 0; k < lattice.size[2]; ++k)
    for (int j = 0; j < lattice.size[1]; ++j)
      for (int i = 0; i < lattice.size[0]; ++i)
        field.values.push_back(static_cast<float>(f(lattice.point(i, j, k)) / lattice.voxel));
  return field;
}

/// A cube of `n` points a side over [-half, half]^3.
inline Lattice centred_lattice(int n, double half) {
  return {.origin = Vec3::Constant(-half), .voxel = 2 * half / (n - 1), .size = {n, n, n}};
}

}  // namespace skinforge::testing
