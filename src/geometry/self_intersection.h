#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/math.h"

namespace skinforge {

/// Whether two triangles cut each other somewhere else than at the corners they share. Corners are shared
/// when their indices are equal. Touching is no cut: an edge of one (none of whose ends is shared) must pass
/// through the other, more than `tolerance` (metres, 0 or more) to both sides of its plane and more than that
/// inside its sides. Two triangles that share an edge cut each other when one is folded onto the other. Other
/// coplanar pairs and degenerate triangles never count.
bool triangles_intersect(std::span<const Vec3> positions, const std::array<std::int32_t, 3>& a,
                         const std::array<std::int32_t, 3>& b, double tolerance);

/// Which pairs of triangles count. Empty spans leave nothing out.
struct PairScope {
  std::span<const std::uint8_t> subset = {};  ///< one of the pair has its flag set
  std::span<const std::int32_t> groups = {};  ///< the two are not of one group, or it is below 0
};

/// Pairs (lower, higher) of triangles that intersect, rising. The tolerance is 1e-9 of the diagonal of the
/// positions. O(n log n) for surfaces that cut themselves in few places. Same result for any number of
/// threads.
std::vector<std::pair<std::int32_t, std::int32_t>> self_intersections(
    std::span<const Vec3> positions, std::span<const std::array<std::int32_t, 3>> triangles,
    const PairScope& scope = {});

/// How many pairs `self_intersections` finds.
std::size_t count_self_intersections(std::span<const Vec3> positions,
                                     std::span<const std::array<std::int32_t, 3>> triangles,
                                     const PairScope& scope = {});

}  // namespace skinforge
