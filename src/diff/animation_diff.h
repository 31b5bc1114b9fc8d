#pragma once

#include "diff/character_diff.h"
#include "diff/correspondence.h"

namespace skinforge {

/// Every clip that both sides have by name, at all key times of both and half way between. Beyond its end a
/// clip holds. Vertices without a counterpart are left out. In A's order. `wants_vertices`: fill in
/// `vertex_max`.
std::vector<ClipDiff> compare_clips(const Character& a, const Character& b, const Correspondence& same,
                                    double diagonal, bool wants_vertices = false);

}  // namespace skinforge
