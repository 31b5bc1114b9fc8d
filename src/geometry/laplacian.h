#pragma once

#include <array>
#include <span>
#include <vector>

#include "base/id.h"
#include "geometry/sparse_factor.h"

namespace skinforge {

using VertexTriangle = std::array<VertexId, 3>;

/// Half the cotangents of the angles of triangles, the weights of the finite element Laplacian: entry k of a
/// triangle belongs to its corner k and to the edge opposite. Assembled per triangle, so surfaces may be open
/// or non-manifold. Corners of a triangle without area (`is_degenerate`) get those of an equilateral one: its
/// vertices stay connected, nothing becomes infinite.
struct CotangentWeights {
  std::vector<std::array<double, 3>> half_cotangents;  ///< #T
  std::size_t degenerate = 0;                          ///< triangles without area
};
CotangentWeights cotangent_weights(std::span<const Vec3> positions,
                                   std::span<const VertexTriangle> triangles);

/// The block of the Laplacian (positive semi-definite, no mass matrix) over some vertices: the matrix of
/// every Laplace and Poisson problem whose other vertices are given (Dirichlet). `local`: for every vertex
/// its row, or -1 where it is given. `rows`: their number. It can be factorised where every connected part of
/// the rows touches a given vertex.
LowerColumns laplacian_block(std::span<const VertexTriangle> triangles,
                             std::span<const std::array<double, 3>> half_cotangents,
                             std::span<const std::int32_t> local, std::size_t rows);

}  // namespace skinforge
