#pragma once

#include <Eigen/Core>

namespace skinforge {

/// Shapes to mix, and the inner product in which they are orthogonal.
struct MorphBasis {
  Eigen::MatrixXd targets;  ///< 3 #V x at most the count asked for; what moves most comes first
  Eigen::VectorXd rows;     ///< 3 #V, weight of each coordinate's squared error
  double largest = 0;       ///< the largest distance that is left of any vertex in any column
};

/// The `count` shapes whose mixes come near the columns of `offsets` (3 #V x #frames: x, y, z of each vertex)
/// in the largest distance. Singular vectors are best in the mean square; what leaves most there, single
/// vertices in single frames, is given more weight and the decomposition repeated, ours after Lawson 1961
/// with weights by vertex and frame; the best round is returned. Fewer shapes where the columns have no more.
/// Zero columns: none. Cost of a round: #frames^2 * #V.
MorphBasis find_morph_basis(const Eigen::MatrixXd& offsets, std::size_t count);

}  // namespace skinforge
