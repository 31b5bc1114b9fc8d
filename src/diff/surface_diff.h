#pragma once

#include "diff/character_diff.h"
#include "diff/correspondence.h"

namespace skinforge {

/// All of the geometry but what belongs to corners: distance of the surfaces in the bind pose, as shares of
/// `diagonal`, vertices without a counterpart or at another place, area and volume.
GeometryDiff compare_surfaces(const Character& a, const Character& b, const Correspondence& same,
                              double diagonal);

/// Weights of corresponding vertices, and of how many joints they are.
SkinDiff compare_weights(const Character& a, const Character& b, const Correspondence& same);

/// How many vertices follow 0, 1, 2 ... joints, up to the most that one follows.
std::vector<std::size_t> count_by_influences(const SkinWeights& weights);

/// Name of the joint with the largest weight at a vertex; empty when it has none.
std::string heaviest_joint(const Character& character, VertexId vertex);

}  // namespace skinforge
