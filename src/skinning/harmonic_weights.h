#pragma once

#include <span>
#include <vector>

#include "geometry/laplacian.h"
#include "model/skin_weights.h"
#include "skinning/handles.h"

namespace skinforge {

/// Harmonic weights as they come from the solver, and what was odd on the way.
struct HarmonicWeights {
  /// One row a vertex, by rising joint, entries of exactly 0 left out. Values may lie outside [0, 1] where
  /// cotangents are negative; rows sum to 1 (1e-13). Empty for vertices in `unreached`.
  SkinWeights weights;
  std::size_t degenerate = 0;       ///< triangles without area (`cotangent_weights`)
  std::vector<VertexId> unreached;  ///< free vertices that no handle is connected to along edges, rising
  double least = 0, largest = 1;    ///< of all weights
};

/// w_k with L w_k = 0 on free vertices, 1 on the handle of k and 0 on the others (ETH Eq. 2, Sec. 4); L is
/// the cotangent Laplacian without mass matrix, natural at open borders. `handles`: one a vertex. The free
/// vertices fall into regions that handles part from each other; each is factorised once and solved for the
/// joints around it only, regions in parallel, so that the cost does not grow with the number of joints.
/// Throws Error (StageFailed) where a region's system is singular.
HarmonicWeights harmonic_weights(std::span<const Vec3> positions, std::span<const VertexTriangle> triangles,
                                 const Handles& handles);

}  // namespace skinforge
