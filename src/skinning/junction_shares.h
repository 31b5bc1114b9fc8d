#pragma once

#include <span>
#include <vector>

#include "geometry/edges.h"
#include "geometry/triangle_bvh.h"
#include "model/polygon_mesh.h"
#include "model/skin_weights.h"
#include "skeleton/joint_map.h"

namespace skinforge {

/// Where a result vertex comes from: a vertex of a preserved part, or (both invalid) a new vertex of a
/// junction.
struct VertexOrigin {
  SourceId source;
  VertexId vertex;  ///< in the mesh of that source's input

  bool is_new() const { return !source.is_valid(); }
};

/// The result mesh as the transfer of attributes sees it.
struct ResultSurface {
  std::span<const Vec3> positions;        ///< #V, model space of the result
  std::span<const VertexOrigin> origins;  ///< #V
  const VertexGraph* graph = nullptr;     ///< along the edges of the result mesh
};

/// One placed source: its whole mesh (what was cut away too) in model space of the result.
struct SourceSurface {
  std::span<const Vec3> positions;           ///< #V of the input, placed
  const Triangulation* triangles = nullptr;  ///< of the input's mesh
  const TriangleBvh* bvh = nullptr;          ///< over `positions` and `triangles`
  std::span<const double> presence;          ///< #V of the input, in [0, 1] (Sec. 6)
  const SkinWeights* weights = nullptr;      ///< of the input
  const JointMap* map = nullptr;             ///< B of this source
  bool attached = false;  ///< joined by Attach (union): shares follow distance, not presence
};

/// How much each source has to say at each vertex of the result.
struct JunctionShares {
  std::vector<std::vector<double>>
      factor;                          ///< [source][#V], in [0, 1]; at every vertex the sum over sources is 1
  std::vector<VertexId> new_vertices;  ///< rising
  std::vector<std::vector<ClosestPoint>>
      closest;  ///< [source][index in `new_vertices`]; triangle -1 where factor is 0
};

/// The interpolating factors of Sec. 7 at every vertex of the result.
///  - At a preserved vertex its source has 1.
///  - At a new vertex factor_k is proportional to s_k * r_k. s_k is the factor of Eq. 1: the presence of
///  source k at its
///    closest point. Where the youngest source involved was attached, Eq. 1 has no factor (the union takes
///    the nearer surface) and s_k = 1 / (d_k^2 + e^2) with d_k the distance to source k and e a tenth of the
///    mean edge: the nearer surface wins by a smooth switch.
///  - r_k is ours: the harmonic function over the junction that is 1 where it meets the preserved part of
///  source k and 0
///    where it meets another, so that factors are exactly (1, 0) and (0, 1) at the borders and nothing steps
///    there. Edge weights are 1 / length: no negative weights, r_k stays in [0, 1].
/// A cluster of new vertices that touches no preserved part takes every source by distance. Without any
/// triangle in any source the factor is 1 for source 0. Throws Error (StageFailed) when the harmonic system
/// fails. Cost: one closest point a new vertex and source involved, one sparse factorisation over the new
/// vertices.
JunctionShares junction_shares(const ResultSurface& result, std::span<const SourceSurface> sources);

}  // namespace skinforge
