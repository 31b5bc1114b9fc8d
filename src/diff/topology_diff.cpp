#include "diff/topology_diff.h"

#include <fmt/format.h>

#include <array>

#include "geometry/genus.h"
#include "geometry/mesh_measures.h"

namespace skinforge {

namespace {
// The faces of a mesh on other vertices.
PolygonMesh moved_to(const PolygonMesh& mesh, const std::vector<VertexId>& vertex_of,
                     const std::vector<Vec3>& positions) {
  PolygonMesh moved;
  moved.positions = positions;
  moved.face_begin = mesh.face_begin;
  for (const VertexId v : mesh.corners) moved.corners.push_back(vertex_of[v.index()]);
  return moved;
}

// Of those vertices of A that share a counterpart, the one that it has in A.
std::vector<VertexId> common_vertices_of_a(const Correspondence& same) {
  std::vector<VertexId> common;
  for (std::size_t v = 0; v < same.vertices.size(); ++v) {
    const VertexId image = same.vertices[v];
    const VertexId back = image.is_valid() ? same.back[image.index()] : VertexId();
    common.push_back(back.is_valid() ? back : VertexId(v));
  }
  return common;
}

// Behind the vertices of A come those of B that have no counterpart.
std::vector<VertexId> common_vertices_of_b(const Correspondence& same, const std::vector<VertexId>& of_a) {
  std::vector<VertexId> common;
  for (std::size_t w = 0; w < same.back.size(); ++w)
    common.push_back(same.back[w].is_valid() ? of_a[same.back[w].index()] : VertexId(of_a.size() + w));
  return common;
}
}  // namespace

std::vector<std::string> compare_topology(const Character& a, const Character& b, const Correspondence& same,
                                          const CharacterCounts& of_a, const CharacterCounts& of_b) {
  const auto numbers = [](const CharacterCounts& c) {
    return std::array{c.components, c.open_edges, c.non_manifold_edges, c.genus, c.boundary_loops};
  };
  std::vector<std::string> edits;
  const auto compare = [&](const char* what, std::size_t in_a, std::size_t in_b) {
    if (in_a != in_b) edits.push_back(fmt::format("{} {}, there were {}", in_b, what, in_a));
  };
  compare("triangles", of_a.triangles, of_b.triangles);
  if (numbers(of_a) == numbers(of_b)) return edits;
  std::vector<Vec3> positions = a.mesh.positions;
  positions.insert(positions.end(), b.mesh.positions.begin(), b.mesh.positions.end());
  const std::vector<VertexId> vertices_of_a = common_vertices_of_a(same);
  const PolygonMesh mesh_a = moved_to(a.mesh, vertices_of_a, positions),
                    mesh_b = moved_to(b.mesh, common_vertices_of_b(same, vertices_of_a), positions);
  const MeshTopology in_a = measure_topology(mesh_a), in_b = measure_topology(mesh_b);
  compare("components", in_a.components, in_b.components);
  compare("open edges", in_a.boundary_edges, in_b.boundary_edges);
  compare("non-manifold edges", in_a.non_manifold_edges, in_b.non_manifold_edges);
  const SurfaceGenus genus_a = measure_genus(mesh_a), genus_b = measure_genus(mesh_b);
  if (genus_a.handles != genus_b.handles)
    edits.push_back(fmt::format("genus {}, it was {}", genus_b.handles, genus_a.handles));
  compare("boundary loops", genus_a.boundary_loops, genus_b.boundary_loops);
  return edits;
}

}  // namespace skinforge
