#pragma once

#include <span>
#include <vector>

#include "geometry/laplacian.h"

namespace skinforge {

/// Poisson stitching (ETH Sec. 7.2, Eq. 6): the vertices whose deformation gradients come nearest to a given
/// matrix on each face, in the sense of least squares over the rest area, with some vertices held.
/// The system is the cotangent Laplacian, and the right side follows from its weights too: for each face f
/// and edge (i, j) it gets half the cotangent opposite times M_f (x_i - x_j), which is the gradient form with
/// the blocks transposed (a row of a block is d/dx) and weighted by areas. One factor serves every frame; x,
/// y and z are solved in one walk over it.
class PoissonStitcher {
 public:
  /// `positions`: rest pose, #V. `held`: vertices whose places will be given. Every connected part of the
  /// surface needs one: where it has none its lowest vertex is held, too, as are vertices without faces.
  PoissonStitcher(std::span<const Vec3> positions, std::span<const VertexTriangle> triangles,
                  std::span<const VertexId> held);

  /// Those vertices, and the ones held in addition, rising.
  std::span<const VertexId> held() const { return held_; }
  /// How many of them were added.
  std::size_t added() const { return added_; }
  std::size_t degenerate() const { return degenerate_; }  ///< triangles without area

  /// The stitched surface, #V. `maps`: one matrix a face, from rest; `places`: #V, read at held vertices
  /// only, which come out there exactly. Linear in faces and factor; same bits for any number of threads.
  std::vector<Vec3> stitch(std::span<const Mat3> maps, std::span<const Vec3> places) const;

 private:
  void hold_parts(std::size_t vertex_count, std::span<const VertexId> held);

  std::vector<Vec3> rest_;
  std::vector<VertexTriangle> triangles_;
  std::vector<std::array<double, 3>> half_cotangents_;
  std::vector<VertexId> held_;
  std::vector<std::int32_t> local_;  ///< row of each vertex; -1 where it is held
  std::size_t added_ = 0, degenerate_ = 0, rows_ = 0;
  std::unique_ptr<SparseFactor> factor_;
};

}  // namespace skinforge
