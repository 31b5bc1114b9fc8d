#pragma once

#include "surface/junction_loop.h"
#include "surface/triangle_patch.h"

namespace skinforge {

/// A vertex of a preserved mesh next to the border, joined by an edge to a fixed vertex of the patch.
struct Support {
  std::int32_t fixed = 0;  ///< index of the fixed vertex
  Vec3 position = Vec3::Zero();
};

/// The supports of a patch whose fixed vertices are those of `loops`, loop after loop.
std::vector<Support> supports_of(const std::vector<JunctionLoop>& loops);

/// Places the free vertices so that the sum of squared umbrella Laplacians is least (thin plate), the fixed
/// vertices and the supports given: the cap leaves its border along the neighbours' slope instead of as a
/// flat soap film. Needs at least one fixed vertex in each piece; a system that cannot be solved leaves the
/// patch as it is.
TrianglePatch fair(const TrianglePatch& patch, const std::vector<Support>& supports);

}  // namespace skinforge
