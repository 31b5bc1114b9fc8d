#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/edges.h"

namespace skinforge {

/// Laplacian smoothing of one number per vertex (presence smoothing of SkinMixer Sec. 6).
struct SmoothingOptions {
  int passes = 1;            ///< 0 or more; Sec. 6 takes one
  double self_weight = 0.5;  ///< [0, 1]: the rest goes to the mean of the neighbours; ours
};

/// `values` (one per vertex) after that many passes. Where `is_free` (one per vertex) is 0 the value stays,
/// as it does at a vertex without neighbours. Every pass reads the values of the pass before, so the order of
/// vertices does not matter.
std::vector<double> smooth_scalar(const VertexGraph& graph, std::vector<double> values,
                                  std::span<const std::uint8_t> is_free,
                                  const SmoothingOptions& options = {});

/// Shortest ways along edges from a set of vertices.
struct GeodesicDistance {
  std::vector<double> distance;  ///< per vertex, metres; +inf where no source is reached
  std::vector<VertexId> source;  ///< per vertex: the nearest source, ties to the lower id; invalid if none
};

/// Dijkstra on the vertex graph; the length of an edge is that between its positions. O(n log n).
GeodesicDistance geodesic_distance(const VertexGraph& graph, std::span<const Vec3> positions,
                                   std::span<const VertexId> sources);
GeodesicDistance geodesic_distance(const PolygonMesh& mesh, std::span<const VertexId> sources);

}  // namespace skinforge
