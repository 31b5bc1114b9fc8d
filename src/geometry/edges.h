#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "model/polygon_mesh.h"

namespace skinforge {

/// One undirected edge with all its faces: inputs may be non-manifold, so this is a list, not a half-edge.
struct Edge {
  std::array<VertexId, 2> vertices;  ///< lower id first
  std::vector<std::int32_t>
      half_edges;  ///< corner index c of each face that runs along it: from corner c to the next
};

/// Edges of a polygon mesh, sorted by their vertex pair.
struct EdgeList {
  std::vector<Edge> edges;
  std::vector<std::int32_t> edge_of_corner;  ///< #C: the edge from corner c to the next corner of its face
  std::vector<FaceId> face_of_corner;        ///< #C
  std::vector<std::int32_t> next_corner;     ///< #C: the next corner in the same face
};
EdgeList build_edges(const PolygonMesh& mesh);

/// Neighbours of each vertex along edges, in CSR form, rising.
struct VertexGraph {
  std::vector<std::int32_t> begin = {0};
  std::vector<VertexId> neighbours;
  std::span<const VertexId> of(VertexId v) const;
};
VertexGraph build_vertex_graph(const PolygonMesh& mesh);

/// Connected components of the faces (two faces are connected when they share a vertex): component per vertex
/// and per face, numbered by their lowest face; vertices of no face get -1.
struct Components {
  std::vector<std::int32_t> of_vertex;
  std::vector<std::int32_t> of_face;
  std::int32_t count = 0;
};
Components connected_components(const PolygonMesh& mesh);

/// Mean edge length in metres over all edges; 0 for a mesh without faces.
double mean_edge_length(const PolygonMesh& mesh);

}  // namespace skinforge
