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

// A side of a face: its vertices, lower first, and its corner.
using Side = std::pair<VertexPair, std::int32_t>;

// By vertices, then by corner. The lower vertex first puts each into a short list of its own.
std::vector<Side> sorted_sides(const PolygonMesh& mesh, const std::vector<std::int32_t>& next_corner) {
  const auto vertices = [&](std::size_t c) {
    return sorted_pair(mesh.corners[c], mesh.corners[next_corner[c]]);
  };
  VertexId largest(0);
  for (const VertexId v : mesh.corners) largest = std::max(largest, v);
  std::vector<std::ptrdiff_t> begin(largest.index() + 2, 0);
  for (std::size_t c = 0; c < next_corner.size(); ++c) ++begin[vertices(c)[0].index() + 1];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<std::ptrdiff_t> next(begin.begin(), begin.end() - 1);
  std::vector<Side> sides(next_corner.size());
  for (std::size_t c = 0; c < next_corner.size(); ++c) {
    const VertexPair pair = vertices(c);
    sides[static_cast<std::size_t>(next[pair[0].index()]++)] = {pair, static_cast<std::int32_t>(c)};
  }
  for (std::size_t v = 0; v + 1 < begin.size(); ++v)
    std::sort(sides.begin() + begin[v], sides.begin() + begin[v + 1]);
  return sides;
}

}  // namespace

EdgeList build_edges(const PolygonMesh& mesh) {
  const std::size_t count = mesh.corner_count();
  EdgeList list;
  list.edge_of_corner.resize(count);
  list.face_of_corner.resize(count);
  list.next_corner.resize(count);
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const std::int32_t begin = mesh.face_begin[f], end = mesh.face_begin[f + 1];
    for (std::int32_t c = begin; c < end; ++c) {
      list.face_of_corner[c] = FaceId(f);
      list.next_corner[c] = c + 1 < end ? c + 1 : begin;
    }
  }
  const std::vector<Side> sides = sorted_sides(mesh, list.next_corner);
  for (std::size_t first = 0, end = 0; first < sides.size(); first = end) {
    while (end < sides.size() && sides[end].first == sides[first].first) ++end;
    Edge& edge = list.edges.emplace_back(Edge{sides[first].first, {}});
    edge.half_edges.reserve(end - first);
    for (std::size_t s = first; s < end; ++s) {
      edge.half_edges.push_back(sides[s].second);
      list.edge_of_corner[sides[s].second] = static_cast<std::int32_t>(list.edges.size()) - 1;
    }
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
