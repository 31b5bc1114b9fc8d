#pragma once

#include <optional>
#include <vector>

#include "surface/borders.h"

namespace skinforge {

/// Vertices of a patch from border to border, neighbours joined by edges.
using SeamPath = std::vector<std::int32_t>;

/// Metres.
double length_of(const TrianglePatch& patch, const SeamPath& path);

/// Which of a tube's two borders each loop belongs to.
using BorderSides = std::vector<bool>;

/// Shortest seams along edges of the patch, one after the other, until all loops of a side are one; none when
/// seams would touch each other or a border. A side of one loop needs no seam.
std::optional<std::vector<SeamPath>> shortest_seams(const TrianglePatch& patch,
                                                    const std::vector<IndexLoop>& loops,
                                                    const BorderSides& is_on_b);

}  // namespace skinforge
