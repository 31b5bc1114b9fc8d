#pragma once

#include "diff/character_diff.h"
#include "diff/correspondence.h"

namespace skinforge {

/// Distance of the surfaces in the bind pose, as shares of `diagonal`; vertices without a counterpart.
GeometryDiff compare_surfaces(const Character& a, const Character& b, const Correspondence& same,
                              double diagonal);

/// Weights of corresponding vertices.
SkinDiff compare_weights(const Character& a, const Character& b, const Correspondence& same);

/// Name of the joint with the largest weight at a vertex; empty when it has none.
std::string heaviest_joint(const Character& character, VertexId vertex);

}  // namespace skinforge
