#pragma once

#include <span>
#include <vector>

#include "model/character.h"

namespace skinforge {

/// Linear blend skinning (ETH Eq. 3): v' = (sum of w_j * palette_j) v.
/// `positions`: #V, bind pose, metres (morphed first where the pose has morph weights). `weights`: one row a
/// vertex; rows are used as they are, not normalised; a vertex without influences stays. `palette`: one
/// matrix a joint, as `skinning_palette` gives. Linear in influences, parallel over vertices, same bits for
/// any number of threads.
std::vector<Vec3> linear_blend(std::span<const Vec3> positions, const SkinWeights& weights,
                               std::span<const Affine3> palette);

/// The blended matrix of one row, sum of w_j * palette_j; the identity for an empty row.
Affine3 blended_map(std::span<const Influence> row, std::span<const Affine3> palette);

/// Corner normals carried along by the inverse transpose of the blended matrix, unit length again; a zero
/// normal, or one that a singular matrix sends to zero, comes out zero. `normals`, `corners`: #C, a normal
/// and its vertex.
std::vector<Vec3> linear_blend_normals(std::span<const Vec3> normals, std::span<const VertexId> corners,
                                       const SkinWeights& weights, std::span<const Affine3> palette);

}  // namespace skinforge
