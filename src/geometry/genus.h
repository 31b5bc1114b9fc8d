#pragma once

#include <cstdint>

#include "model/polygon_mesh.h"

namespace skinforge {

/// Handles and holes of a surface, component by component: of faces that share edges, so that two fans at one
/// vertex are two vertices. The genus g of a component follows from Euler's V - E + F = 2 - 2 g - b, where b
/// is the number of its boundary loops.
struct SurfaceGenus {
  std::size_t handles = 0;         ///< sum of g: 0 for balls and discs, 1 for a ring
  std::size_t boundary_loops = 0;  ///< sum of b; 0 for closed ones
  std::size_t closed = 0, open = 0;
  /// Components with an edge of more than two faces, or of two that run along it the same way: they are no
  /// surfaces, have no genus, and count in none of the other numbers.
  std::size_t non_manifold = 0;
};
SurfaceGenus measure_genus(const PolygonMesh& mesh);

}  // namespace skinforge
