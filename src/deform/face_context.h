#pragma once

#include <memory>
#include <span>
#include <vector>

#include "deform/face_rotations.h"
#include "deform/poisson_stitch.h"

namespace skinforge {

/// The 3 x 3 map from one triangle to another: edges to edges and unit normal to unit normal. The identity
/// where the rest triangle has no area.
Mat3 triangle_map(const std::array<Vec3, 3>& rest, const std::array<Vec3, 3>& posed);

enum class FaceContextKind : std::uint8_t {
  Linear,  ///< ETH Eq. 9: R (sum of a_j T_j)
  Polar,   ///< ETH Eq. 10: T_j = Q_j S_j, R (average of the Q_j) (sum of a_j S_j)
};

/// What examples change on each face (ETH Sec. 8.2): T_jf, with the rotation of the pose taken out.
class FaceContext {
 public:
  /// Direct form (default, ours): T_jf = R_f(P_j)^T J_f with J_f from rest to the example, which gives the
  /// examples back exactly where the held vertices are placed as in the examples. Stitched form (the
  /// sheet's): the maps R_f^T J_f are first stitched to an unposed surface with the held vertices at rest,
  /// and T_jf is measured on that; its error on its own examples was 0.004 to 0.01 of a human 1.8 high.
  enum class Form : std::uint8_t { Direct, Stitched };

  /// `stitcher`, `blend`: of the same mesh. `examples`: #V each; `bones`: rotations of the bones (absolute,
  /// one a joint) in the pose of each example.
  FaceContext(const PoissonStitcher& stitcher, const FaceBlend& blend, std::span<const Vec3> rest,
              std::span<const VertexTriangle> triangles, std::span<const std::vector<Vec3>> examples,
              std::span<const std::vector<Quat>> bones, Form form = Form::Direct);

  /// R(f)' of ETH Eq. 9 or 10. `rotations`: R(f), one a face; `weights`: a_j, one an example.
  std::vector<Mat3> maps(std::span<const Quat> rotations, std::span<const double> weights,
                         FaceContextKind kind) const;
  /// The unposed surface of an example (Stitched form only; else empty).
  const std::vector<Vec3>& unposed(std::size_t example) const { return unposed_[example]; }

 private:
  std::vector<std::vector<Mat3>> maps_;      ///< [example][face]
  std::vector<std::vector<Quat>> rotation_;  ///< Q of each
  std::vector<std::vector<Mat3>> stretch_;   ///< S of each
  std::vector<std::vector<Vec3>> unposed_;
};

}  // namespace skinforge
