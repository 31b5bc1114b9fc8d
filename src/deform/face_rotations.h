#pragma once

#include <span>
#include <vector>

#include "geometry/laplacian.h"
#include "model/skin_weights.h"

namespace skinforge {

/// A rotation and its share in an average.
struct WeightedRotation {
  Quat rotation;
  double weight = 0;  ///< of example weights (ETH Eq. 10) some may be negative
};

/// The average of rotations in the Frobenius norm (ETH Eq. 5, Markley 2007 Eq. 12, 13): the eigenvector of
/// the largest eigenvalue of the sum of w q q^T; q and -q count alike. Where the largest eigenvalue is not
/// single (half turns of equal weight against each other) the largest weight alone decides, the first on
/// ties: never NaN. No rotation at all: identity. Two rotations are averaged in closed form, more by Newton
/// steps for the eigenvalue.
Quat average_rotation(std::span<const WeightedRotation> rotations);

/// Average rotation of each face by h_k(f), the means of the weights of its vertices (ETH Sec. 7.1). Made
/// once for a skin, asked for every frame: faces that one bone holds alone need no average.
class FaceBlend {
 public:
  FaceBlend(std::span<const VertexTriangle> triangles, const SkinWeights& weights);

  std::size_t face_count() const { return rows_.vertex_count(); }
  /// h_k(f): one row a face, joints rising, each once.
  const SkinWeights& weights() const { return rows_; }
  /// One rotation a face. `bones`: absolute rotations with respect to rest, one a joint. Parallel, same bits
  /// for any number of threads.
  std::vector<Quat> rotations(std::span<const Quat> bones) const;

 private:
  SkinWeights rows_;
};

}  // namespace skinforge
