#pragma once

#include <cstdint>
#include <vector>

#include "model/polygon_mesh.h"

namespace skinforge {

/// Counts of what a mesh is made of (junction.md c). Edges are undirected, by vertex pair.
struct MeshTopology {
  std::size_t vertices = 0;  ///< used by some face
  std::size_t edges = 0;
  std::size_t faces = 0;
  std::size_t triangles = 0, quads = 0;
  std::size_t boundary_edges = 0;         ///< one face
  std::size_t non_manifold_edges = 0;     ///< more than two faces, or two that run along it the same way
  std::size_t non_manifold_vertices = 0;  ///< their faces form more than one fan
  std::size_t components = 0;             ///< of faces that share vertices
  std::size_t degenerate_faces =
      0;                   ///< a vertex twice, or an area below 1e-6 of the squared mean edge length
  std::int64_t euler = 0;  ///< vertices - edges + faces

  bool is_closed() const { return boundary_edges == 0; }
};
MeshTopology measure_topology(const PolygonMesh& mesh);

/// Edges with one face, and edges that are not manifold, as indices into `build_edges(mesh).edges`, rising.
std::vector<std::int32_t> boundary_edges(const PolygonMesh& mesh);
std::vector<std::int32_t> non_manifold_edges(const PolygonMesh& mesh);

/// Scaled Jacobian of every face (`scaled_jacobian.h`), in face order.
std::vector<double> face_qualities(const PolygonMesh& mesh);

}  // namespace skinforge
