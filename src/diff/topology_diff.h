#pragma once

#include "diff/character_diff.h"
#include "diff/correspondence.h"

namespace skinforge {

/// One sentence for each of triangles, components, open and non-manifold edges, genus and boundary loops that
/// differ. How far
/// vertices at one place were welded depends on who wrote the file, so where the sides' own counts differ
/// they are counted anew with both laid on the same vertices: those of one place that have one counterpart
/// are one.
std::vector<std::string> compare_topology(const Character& a, const Character& b, const Correspondence& same,
                                          const CharacterCounts& of_a, const CharacterCounts& of_b);

}  // namespace skinforge
