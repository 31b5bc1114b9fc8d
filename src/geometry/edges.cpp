#include "geometry/edges.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace skinforge {
namespace {

using VertexPair = std::array<VertexId, 2>;

VertexPair sorted_pair(VertexId a, VertexId b) {
  return a < b ? VertexPair{a, b} : VertexPair{b, a};
}

// Root of a union-find forest in which every root is the lowest member of its set.
std::int32_t root_of(std::vector<std::int32_t>& parent, std::int32_t i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

void unite(std::vector<std::int32_t>& parent, std::int32_t a, std::int32_t b) {
  a = root_of(parent, a);
  b = root_of(parent, b);
  parent[std::max(a, b)] = std::min(a, b);
}

}  // namespace

EdgeList build_edges(const PolygonMesh& mesh) {
  const std::size_t count = mesh.corner_count();
  EdgeList list;
  list.edge_of_corner.resize(count);
  list.face_of_corner.resize(count);
  list.next_corner.resize(count);
  std::vector<std::pair<VertexPair, std::int32_t>> sides(count);
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const std::int32_t begin = mesh.face_begin[f], end = mesh.face_begin[f + 1];
    for (std::int32_t c = begin; c < end; ++c) {
      const std::int32_t next = c + 1 < end ? c + 1 : begin;
      list.face_of_corner[c] = FaceId(f);
      list.next_corner[c] = next;
      sides[c] = {sorted_pair(mesh.corners[c], mesh.corners[next]), c};
    }
  }
  std::sort(sides.begin(), sides.end());
  for (const auto& [pair, corner] : sides) {
    if (list.edges.empty() || list.edges.back().vertices != pair) list.edges.push_back({pair, {}});
    list.edges.back().half_edges.push_back(corner);
    list.edge_of_corner[corner] = static_cast<std::int32_t>(list.edges.size()) - 1;
  }
  return list;
}

std::span<const VertexId> VertexGraph::of(VertexId v) const {
  const auto first = static_cast<std::size_t>(begin[v.index()]);
  return {neighbours.data() + first, static_cast<std::size_t>(begin[v.index() + 1]) - first};
}

VertexGraph build_vertex_graph(const PolygonMesh& mesh) {
  std::vector<VertexPair> links;
  for (const Edge& edge : build_edges(mesh).edges) {
    const auto [a, b] = edge.vertices;
    if (a == b) continue;  // a face that repeats a vertex
    links.push_back({a, b});
    links.push_back({b, a});
  }
  std::sort(links.begin(), links.end());
  VertexGraph graph;
  graph.begin.assign(mesh.vertex_count() + 1, 0);
  for (const auto& [from, to] : links) {
    ++graph.begin[from.index() + 1];
    graph.neighbours.push_back(to);
  }
  std::partial_sum(graph.begin.begin(), graph.begin.end(), graph.begin.begin());
  return graph;
}

Components connected_components(const PolygonMesh& mesh) {
  std::vector<std::int32_t> parent(mesh.vertex_count());
  std::iota(parent.begin(), parent.end(), 0);
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(FaceId(f));
    for (const VertexId v : face) unite(parent, face.front().value, v.value);
  }
  Components result;
  result.of_vertex.assign(mesh.vertex_count(), -1);
  result.of_face.resize(mesh.face_count());
  std::vector<std::int32_t> number(mesh.vertex_count(), -1);
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(FaceId(f));
    std::int32_t& component = number[root_of(parent, face.front().value)];
    if (component < 0) component = result.count++;
    result.of_face[f] = component;
    for (const VertexId v : face) result.of_vertex[v.index()] = component;
  }
  return result;
}

double mean_edge_length(const PolygonMesh& mesh) {
  const std::vector<Edge> edges = build_edges(mesh).edges;
  if (edges.empty()) return 0;
  double sum = 0;
  for (const Edge& edge : edges)
    sum += (mesh.positions[edge.vertices[0].index()] - mesh.positions[edge.vertices[1].index()]).norm();
  return sum / static_cast<double>(edges.size());
}

}  // namespace skinforge
