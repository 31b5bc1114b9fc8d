#pragma once

#include <span>
#include <vector>

#include "geometry/laplacian.h"
#include "model/skin_weights.h"
#include "skinning/bone_segments.h"

namespace skinforge {

struct BoneHeatOptions {
  int resolution = 96;  ///< cells along the longest side of the character; [16, 512]
};

/// Weights by heat from the bones (Baran and Popovic 2007, Sec. 4: -Laplacian w + H w = H p), with distances
/// through the inside of the character (geodesic voxels, Dionne and de Lasa 2013) in the place of their test
/// of visibility: every vertex v is heated by the bone nearest to it that way, with H = 1 / d^2. Such a
/// system is never singular, so parts without a handle, open borders and non-manifold faces are no special
/// cases, and two fingers that touch do not share weights. Negative cotangents count as 0: weights lie in [0,
/// 1] and rows sum to 1. A part that no bone reaches through filled cells takes straight distances. One row a
/// vertex, joints rising, weights below 1e-4 dropped. Cost: one Dijkstra a bone over filled cells, one
/// factorisation for all bones.
SkinWeights bone_heat_weights(std::span<const Vec3> positions, std::span<const VertexTriangle> triangles,
                              std::span<const BoneSegment> segments, const BoneHeatOptions& options = {});

}  // namespace skinforge
