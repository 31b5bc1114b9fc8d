#pragma once

#include <span>
#include <vector>

#include "model/skin_weights.h"
#include "skeleton/rigid_motion.h"

namespace skinforge {

/// A posed shape brought back through linear blend skinning.
struct Unposed {
  std::vector<Vec3> offsets;     ///< #V: delta = T^-1 v - rest (ETH Sec. 8.1.1, 8.1.2)
  double worst_condition = 1;    ///< largest condition number of a blended matrix
  std::vector<VertexId> damped;  ///< vertices whose matrix was nearly singular, rising
};

/// The offsets from rest that linear blend skinning turns into `posed`. Where the blended matrix T is nearly
/// singular (condition above 1000: half turns against each other) no offset can reach every place; there the
/// least squares answer with damped inverse singular values is taken, and the vertex is listed: finite
/// always. `rest`, `posed`: #V; `weights`: those that will be played; `palette`: of the pose, one a joint.
/// Parallel.
Unposed unpose(std::span<const Vec3> rest, std::span<const Vec3> posed, const SkinWeights& weights,
               std::span<const Affine3> palette);

}  // namespace skinforge
