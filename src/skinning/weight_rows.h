#pragma once

#include <array>
#include <span>
#include <vector>

#include "model/skin_weights.h"
#include "skeleton/joint_map.h"

namespace skinforge {

/// W' = B(W) for one row (SkinMixer Sec. 7.1): every influence goes to the image of its joint, several joints
/// on one image are summed. Sorted by falling weight, ties by joint. A row whose joints all have confidence 1
/// keeps its weights to the bit. Otherwise each weight is first multiplied by the confidence of its joint and
/// the row scaled to sum 1 (ours: the paper moves the full weight, also to images that it calls loosely
/// defined); where every confidence is 0, the full weights are moved.
std::vector<Influence> retargeted_row(std::span<const Influence> row, const JointMap& map);

/// `retargeted_row` of every vertex. Linear.
SkinWeights retarget(const SkinWeights& weights, const JointMap& map);

/// Row at a point of a triangle: its corners' rows mixed by `barycentric` (each >= 0, sum 1), in normal form.
std::vector<Influence> interpolate_row(const SkinWeights& weights, const std::array<VertexId, 3>& triangle,
                                       const Vec3& barycentric);

/// A row and its share in a mix.
struct RowShare {
  std::span<const Influence> row;
  double factor = 0;  ///< >= 0; need not sum to 1 over the mix
};

/// Mix of rows in normal form: at most `limit` influences (0 = all), sum 1 (Sec. 7.1: the N largest,
/// renormalised). Empty when no row with a positive factor has a positive weight.
std::vector<Influence> blend_rows(std::span<const RowShare> shares, std::size_t limit);

/// Sum over all joints of |a_j - b_j|: 0 for equal rows, 2 for rows without a common joint (each of sum 1).
/// Any order.
double row_distance(std::span<const Influence> a, std::span<const Influence> b);

}  // namespace skinforge
