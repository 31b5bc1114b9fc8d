#include "geometry/mesh_measures.h"

#include <algorithm>
#include <cmath>

#include "geometry/disjoint_sets.h"
#include "geometry/edges.h"
#include "geometry/scaled_jacobian.h"

namespace skinforge {
namespace {

constexpr double kDegenerateArea = 1e-6;  // junction.md c, of the squared length

bool is_manifold(const PolygonMesh& mesh, const Edge& edge) {
  if (edge.half_edges.size() > 2) return false;
  return edge.half_edges.size() < 2 || mesh.corners[edge.half_edges[0]] != mesh.corners[edge.half_edges[1]];
}

template <class Predicate>
std::vector<std::int32_t> edges_where(const PolygonMesh& mesh, const Predicate& holds) {
  std::vector<std::int32_t> found;
  const std::vector<Edge> edges = build_edges(mesh).edges;
  for (std::size_t e = 0; e < edges.size(); ++e)
    if (holds(edges[e])) found.push_back(static_cast<std::int32_t>(e));
  return found;
}

bool repeats_vertex(std::span<const VertexId> face) {
  std::vector<VertexId> sorted(face.begin(), face.end());
  std::sort(sorted.begin(), sorted.end());
  return std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end();
}

std::size_t count_degenerate(const PolygonMesh& mesh) {
  const double edge = mean_edge_length(mesh), least = kDegenerateArea * edge * edge;
  std::size_t count = 0;
  for (std::size_t f = 0; f < mesh.face_count(); ++f)
    count += repeats_vertex(mesh.face(FaceId(f))) || !(area_normal(mesh, FaceId(f)).norm() / 2 > least);
  return count;
}

// Fans per vertex: corners joined by an edge of two faces at their vertex belong to one fan.
class Fans {
 public:
  Fans(const PolygonMesh& mesh, const EdgeList& edges) : mesh_(mesh), fans_(mesh.corner_count()) {
    for (const Edge& edge : edges.edges)
      for (std::size_t i = 1; i < edge.half_edges.size(); ++i)
        join(edges, edge.half_edges[0], edge.half_edges[i]);
  }

  std::size_t vertices_with_several() {
    std::vector<std::int32_t> fans(mesh_.vertex_count(), 0);
    for (std::size_t c = 0; c < mesh_.corner_count(); ++c)
      if (fans_.is_root(static_cast<std::int32_t>(c))) ++fans[mesh_.corners[c].index()];
    return static_cast<std::size_t>(std::count_if(fans.begin(), fans.end(), [](int n) { return n > 1; }));
  }

 private:
  // The corners of two half-edges of one edge, at both of its vertices.
  void join(const EdgeList& edges, std::int32_t a, std::int32_t b) {
    const std::int32_t a_end = edges.next_corner[a], b_end = edges.next_corner[b];
    const bool same_way = mesh_.corners[a] == mesh_.corners[b];
    fans_.unite(a, same_way ? b : b_end);
    fans_.unite(a_end, same_way ? b_end : b);
  }

  const PolygonMesh& mesh_;
  DisjointSets fans_;
};

}  // namespace

MeshTopology measure_topology(const PolygonMesh& mesh) {
  const EdgeList edges = build_edges(mesh);
  MeshTopology t;
  std::vector<std::uint8_t> is_used(mesh.vertex_count(), 0);
  for (const VertexId v : mesh.corners) is_used[v.index()] = 1;
  t.vertices = static_cast<std::size_t>(std::count(is_used.begin(), is_used.end(), 1));
  t.edges = edges.edges.size();
  t.faces = mesh.face_count();
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    t.triangles += mesh.face(FaceId(f)).size() == 3;
    t.quads += mesh.face(FaceId(f)).size() == 4;
  }
  for (const Edge& edge : edges.edges) {
    t.boundary_edges += edge.half_edges.size() == 1;
    t.non_manifold_edges += !is_manifold(mesh, edge);
  }
  t.non_manifold_vertices = Fans(mesh, edges).vertices_with_several();
  t.components = static_cast<std::size_t>(connected_components(mesh).count);
  t.degenerate_faces = count_degenerate(mesh);
  t.euler = static_cast<std::int64_t>(t.vertices + t.faces) - static_cast<std::int64_t>(t.edges);
  return t;
}

std::vector<std::int32_t> boundary_edges(const PolygonMesh& mesh) {
  return edges_where(mesh, [](const Edge& edge) { return edge.half_edges.size() == 1; });
}

std::vector<std::int32_t> non_manifold_edges(const PolygonMesh& mesh) {
  return edges_where(mesh, [&](const Edge& edge) { return !is_manifold(mesh, edge); });
}

std::vector<double> face_qualities(const PolygonMesh& mesh) {
  std::vector<double> qualities;
  qualities.reserve(mesh.face_count());
  std::vector<Vec3> polygon;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    polygon.clear();
    for (const VertexId v : mesh.face(FaceId(f))) polygon.push_back(mesh.positions[v.index()]);
    qualities.push_back(scaled_jacobian(polygon));
  }
  return qualities;
}

}  // namespace skinforge
