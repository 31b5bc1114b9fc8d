#pragma once

#include "diff/character_diff.h"
#include "diff/correspondence.h"

namespace skinforge {

/// Normals and UVs of corresponding corners, for `GeometryDiff`: the corner of B at the counterpart of the
/// vertex, in the face that shares most vertices with A's. Where faces were split otherwise several do: then
/// each value of A is compared with the nearest of theirs. Corners without a counterpart, without a normal
/// and UV sets that one side lacks are left out. Parallel over faces, same result for any number of threads.
void compare_corners(const Character& a, const Character& b, const Correspondence& same, GeometryDiff& diff);

}  // namespace skinforge
