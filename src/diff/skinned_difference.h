#pragma once

#include <optional>
#include <span>
#include <vector>

#include "diff/correspondence.h"
#include "model/character.h"

namespace skinforge {

/// How far linear blending moves the vertices of two characters apart, for many poses. Written out, the way
/// from a vertex of B to its counterpart in A is a sum over few bones,
///   d_v = sum_j a_vj (P_j - Q_j) x_v  +  sum_k Q_k (a_vk x_v - b_vk y_v),
/// P and Q the palettes of A and B, j and k joints that stand for each other, a and b the weights, x and y
/// the positions (unmatched joints are in the sum of their own side). All vectors are known before any pose,
/// so that the mean over all vertices is a quadratic form of the palettes, and boxes of vertices give a
/// bound that leaves nearly all of them out of the search for the largest.
class SkinnedDifference {
 public:
  /// Both must outlive it; neither may have morph targets that clips move. O(#V log #V).
  SkinnedDifference(const Character& a, const Character& b, const Correspondence& same);

  /// Vertices that are compared.
  std::size_t count() const { return order_.size(); }

  struct Distance {
    double square = 0;  ///< square metres
    VertexId vertex;    ///< of A
  };

  /// One pose of each, as palettes (skinning_palette).
  class Frame {
   public:
    Frame(const SkinnedDifference& model, std::span<const Affine3> of_a, std::span<const Affine3> of_b);
    /// Sum of the squared distances of all vertices; to 1e-12 of it, whatever the number of vertices.
    double sum_of_squares() const;
    /// The vertex that is farthest from its counterpart, of several the first; none where no square is above
    /// `least`. The same bits as blending every vertex; what only rounding makes differ counts as the same.
    std::optional<Distance> largest_above(double least) const;

   private:
    using Matrix34 = Eigen::Matrix<double, 3, 4>;
    double bound(std::size_t chunk) const;
    double square_of(std::size_t pair) const;

    const SkinnedDifference& model_;
    std::span<const Affine3> of_a_, of_b_;
    std::vector<Matrix34> maps_;         // of the terms: P_j - Q_j, then Q_k
    std::vector<Vec3> column_lengths_;   // of each map
    std::vector<double> largest_scale_;  // of each map, at least
  };

 private:
  struct Pair {
    VertexId a, b;
  };
  // Vectors of the sum that belong to one vertex, by map.
  struct Term {
    std::size_t map = 0;
    Vec4 vector;
  };
  struct Product {
    std::size_t first = 0, second = 0;  // maps, first <= second
    Eigen::Matrix4d sum;                // over all vertices, of vector_first vector_second^T
  };
  // What the vectors of the second sum can be in a chunk, about its center c: |r_xyz - r_w c| and |r_w|.
  struct Rest {
    std::size_t map = 0;
    double spread = 0, weight = 0;
  };
  // Vertices near each other that follow the same joints.
  struct Chunk {
    std::size_t begin = 0, end = 0;  // in order_
    Vec3 center = Vec3::Zero(), half = Vec3::Zero();
    double weight = 0;               // largest sum of weights
    std::vector<std::size_t> moved;  // maps of the first sum
    std::vector<Rest> rests;
    double imbalance = 0;  // largest |sum_k r_w|
  };

  std::vector<Term> moved_terms(const Pair& pair) const;
  std::vector<Term> rest_terms(const Pair& pair) const;
  void add_products();
  void add_chunks();
  void split(std::size_t begin, std::size_t end, const std::vector<std::size_t>& moved);
  void add_chunk(std::size_t begin, std::size_t end, const std::vector<std::size_t>& moved);

  const Character& a_;
  const Character& b_;
  std::vector<JointId> image_;  // per joint of A
  std::vector<Pair> order_;
  std::vector<Product> products_;
  std::vector<Chunk> chunks_;
};

}  // namespace skinforge
