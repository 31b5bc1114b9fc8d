#include "surface/border.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

namespace skinforge {
namespace {

int kept_faces_at(const EdgeList& edges, const FaceSet& kept, std::int32_t edge) {
  int count = 0;
  for (const std::int32_t corner : edges.edges[edge].half_edges)
    count += kept[edges.face_of_corner[corner].index()];
  return count;
}

// A border edge has exactly one kept face, and a discarded one as well.
bool is_border_edge(const EdgeList& edges, const FaceSet& kept, std::int32_t edge) {
  return kept_faces_at(edges, kept, edge) == 1 && edges.edges[edge].half_edges.size() > 1;
}

bool is_border_corner(const EdgeList& edges, const FaceSet& kept, std::int32_t corner) {
  return kept[edges.face_of_corner[corner].index()] &&
         is_border_edge(edges, kept, edges.edge_of_corner[corner]);
}

// For each vertex: the border corners that arrive at it, that is, whose edge ends there. New faces leave the
// vertex along them.
std::map<VertexId, std::vector<std::int32_t>> arriving_corners(const PolygonMesh& mesh, const EdgeList& edges,
                                                               const FaceSet& kept) {
  std::map<VertexId, std::vector<std::int32_t>> arriving;
  for (std::size_t c = 0; c < mesh.corner_count(); ++c) {
    const auto corner = static_cast<std::int32_t>(c);
    if (is_border_corner(edges, kept, corner)) arriving[mesh.corners[edges.next_corner[c]]].push_back(corner);
  }
  return arriving;
}

// Corners of kept faces at each vertex.
std::vector<std::vector<std::int32_t>> corners_of_vertices(const PolygonMesh& mesh) {
  std::vector<std::vector<std::int32_t>> corners(mesh.vertex_count());
  for (std::size_t c = 0; c < mesh.corner_count(); ++c)
    corners[mesh.corners[c].index()].push_back(static_cast<std::int32_t>(c));
  return corners;
}

// Fans of kept faces round a vertex: two faces are in one fan when they share an edge at the vertex.
std::vector<std::set<FaceId>> kept_fans(const EdgeList& edges, const FaceSet& kept,
                                        const std::vector<std::int32_t>& corners, VertexId v) {
  std::vector<std::set<FaceId>> fans;
  std::map<std::int32_t, std::vector<FaceId>> by_edge;
  std::set<FaceId> open;
  for (const std::int32_t corner : corners) {
    const FaceId face = edges.face_of_corner[corner];
    if (!kept[face.index()]) continue;
    open.insert(face);
    for (std::int32_t c = edges.next_corner[corner]; c != corner; c = edges.next_corner[c]) {
      const auto& ends = edges.edges[edges.edge_of_corner[c]].vertices;
      if (ends[0] == v || ends[1] == v) by_edge[edges.edge_of_corner[c]].push_back(face);
    }
    by_edge[edges.edge_of_corner[corner]].push_back(face);
  }
  while (!open.empty()) {
    std::set<FaceId> fan{*open.begin()};
    for (bool grew = true; grew;) {
      grew = false;
      for (const auto& [edge, faces] : by_edge) {
        const bool touches =
            std::any_of(faces.begin(), faces.end(), [&](FaceId f) { return fan.contains(f); });
        if (!touches) continue;
        for (const FaceId f : faces) grew |= fan.insert(f).second;
      }
    }
    for (const FaceId f : fan) open.erase(f);
    fans.push_back(std::move(fan));
  }
  return fans;
}

int border_edges_of_face(const PolygonMesh& mesh, const EdgeList& edges, const FaceSet& kept, FaceId face) {
  int count = 0;
  const auto first = static_cast<std::int32_t>(mesh.first_corner(face));
  for (std::size_t k = 0; k < mesh.face(face).size(); ++k)
    count += is_border_edge(edges, kept, edges.edge_of_corner[first + k]);
  return count;
}

// Removing a face is worth it when it leaves the border shorter, and straight quads need two of their four
// edges on it.
bool bends_border(const PolygonMesh& mesh, const EdgeList& edges, const FaceSet& kept, FaceId face) {
  const int on_border = border_edges_of_face(mesh, edges, kept, face);
  return on_border >= 2;
}

}  // namespace

std::vector<BorderChain> border_chains(const PolygonMesh& mesh, const EdgeList& edges, const FaceSet& kept) {
  const auto arriving = arriving_corners(mesh, edges, kept);
  std::map<VertexId, VertexId> next;  // along the new faces: from the end of a kept half-edge to its start
  for (const auto& [vertex, corners] : arriving) next[vertex] = mesh.corners[corners.front()];
  std::set<VertexId> targets;
  for (const auto& [from, to] : next) targets.insert(to);
  std::vector<BorderChain> chains;
  std::set<VertexId> done;
  const auto walk = [&](VertexId start) {
    BorderChain chain;
    VertexId v = start;
    for (auto step = next.find(v); step != next.end() && done.insert(v).second; step = next.find(v)) {
      chain.vertices.push_back(v);
      v = step->second;
    }
    chain.is_closed = v == start;
    if (!chain.is_closed) chain.vertices.push_back(v);
    chains.push_back(std::move(chain));
  };
  for (const auto& [vertex, to] : next)
    if (!targets.contains(vertex)) walk(vertex);  // arcs begin where nothing arrives
  for (const auto& [vertex, to] : next)
    if (!done.contains(vertex)) walk(vertex);
  return chains;
}

void drop_pinches(const PolygonMesh& mesh, const EdgeList& edges, FaceSet& kept) {
  const auto corners = corners_of_vertices(mesh);
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& [vertex, arriving] : arriving_corners(mesh, edges, kept)) {
      if (arriving.size() < 2) continue;
      auto fans = kept_fans(edges, kept, corners[vertex.index()], vertex);
      if (fans.size() < 2) continue;
      std::stable_sort(fans.begin(), fans.end(),
                       [](const auto& a, const auto& b) { return a.size() > b.size(); });
      for (std::size_t i = 1; i < fans.size(); ++i)
        for (const FaceId f : fans[i]) changed |= kept[f.index()] != 0, kept[f.index()] = 0;
    }
  }
}

void open_face_set(const PolygonMesh& mesh, const EdgeList& edges, FaceSet& kept) {
  std::vector<char> on_border(mesh.vertex_count(), 0);
  for (std::size_t c = 0; c < mesh.corner_count(); ++c) {
    if (!is_border_corner(edges, kept, static_cast<std::int32_t>(c))) continue;
    on_border[mesh.corners[c].index()] = 1;
    on_border[mesh.corners[edges.next_corner[c]].index()] = 1;
  }
  std::vector<char> in_core(mesh.vertex_count(), 0);  // vertices of faces that survive the erosion
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(FaceId(f));
    if (!kept[f] || std::any_of(face.begin(), face.end(), [&](VertexId v) { return on_border[v.index()]; }))
      continue;
    for (const VertexId v : face) in_core[v.index()] = 1;
  }
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(FaceId(f));
    const bool at_border =
        std::any_of(face.begin(), face.end(), [&](VertexId v) { return on_border[v.index()]; });
    if (kept[f] && at_border &&
        std::none_of(face.begin(), face.end(), [&](VertexId v) { return in_core[v.index()]; }))
      kept[f] = 0;
  }
}

int straighten_border(const PolygonMesh& mesh, const EdgeList& edges, FaceSet& kept, int max_loss) {
  int removed = 0;
  for (bool changed = true; changed && removed < max_loss;) {
    changed = false;
    for (std::size_t f = 0; f < mesh.face_count() && removed < max_loss; ++f) {
      if (!kept[f] || !bends_border(mesh, edges, kept, FaceId(f))) continue;
      kept[f] = 0;
      ++removed;
      changed = true;
    }
  }
  return removed;
}

namespace {

// Kept faces that are connected by edges.
struct FaceGroups {
  std::vector<std::int32_t> of_face;  // a group is known by one of its faces
  std::vector<int> size;              // by group
  std::vector<int> border_edges;      // by group

  int largest() const { return *std::max_element(size.begin(), size.end()); }
};

FaceGroups group_faces(const PolygonMesh& mesh, const EdgeList& edges, const FaceSet& kept) {
  FaceGroups groups;
  std::vector<std::int32_t>& root = groups.of_face;
  root.resize(mesh.face_count());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](std::int32_t f) {
    while (root[f] != f) f = root[f] = root[root[f]];
    return f;
  };
  for (const Edge& edge : edges.edges) {
    std::int32_t first = -1;
    for (const std::int32_t corner : edge.half_edges) {
      const FaceId face = edges.face_of_corner[corner];
      if (!kept[face.index()]) continue;
      if (first < 0)
        first = find(face.value);
      else
        root[find(face.value)] = first = find(first);
    }
  }
  for (std::size_t f = 0; f < root.size(); ++f) root[f] = find(static_cast<std::int32_t>(f));
  groups.size.assign(mesh.face_count(), 0);
  groups.border_edges.assign(mesh.face_count(), 0);
  for (std::size_t f = 0; f < root.size(); ++f)
    if (kept[f]) ++groups.size[root[f]];
  for (std::size_t e = 0; e < edges.edges.size(); ++e) {
    if (!is_border_edge(edges, kept, static_cast<std::int32_t>(e))) continue;
    for (const std::int32_t corner : edges.edges[e].half_edges)
      if (const FaceId face = edges.face_of_corner[corner]; kept[face.index()])
        ++groups.border_edges[root[face.index()]];
  }
  return groups;
}

// How many chains of the border each group of kept faces has. Groups that meet in a vertex may share a chain.
std::map<std::int32_t, int> chains_of_groups(const PolygonMesh& mesh, const EdgeList& edges,
                                             const FaceSet& kept, const FaceGroups& groups) {
  std::map<VertexId, std::int32_t> group_before;  // of the kept face whose half-edge ends there
  for (const auto& [vertex, corners] : arriving_corners(mesh, edges, kept))
    group_before[vertex] = groups.of_face[edges.face_of_corner[corners.front()].index()];
  std::map<std::int32_t, int> count;
  for (const BorderChain& chain : border_chains(mesh, edges, kept)) {
    std::set<std::int32_t> bounded;
    for (const VertexId v : chain.vertices)
      if (const auto group = group_before.find(v); group != group_before.end()) bounded.insert(group->second);
    for (const std::int32_t group : bounded) ++count[group];
  }
  return count;
}

constexpr int kScrapShare = 20;  // ours: the claws of a foot are a third of what is left of it, and stay

}  // namespace

void drop_crumbs(const PolygonMesh& mesh, const EdgeList& edges, FaceSet& kept, int least_faces) {
  if (mesh.face_count() == 0) return;
  const FaceGroups groups = group_faces(mesh, edges, kept);
  const int largest = groups.largest();
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const std::int32_t g = groups.of_face[f];
    const bool is_small = groups.size[g] < least_faces;
    const bool is_scrap = kScrapShare * groups.size[g] < largest && groups.size[g] <= groups.border_edges[g];
    if (groups.border_edges[g] > 0 && (is_small || is_scrap)) kept[f] = 0;
  }
}

void restore_broken_groups(const PolygonMesh& mesh, const EdgeList& edges, const FaceSet& before,
                           FaceSet& kept) {
  const FaceGroups groups = group_faces(mesh, edges, before);
  const auto chains_before = chains_of_groups(mesh, edges, before, groups);
  const auto chains = chains_of_groups(mesh, edges, kept, groups);
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    if (!before[f]) continue;
    const auto had = chains_before.find(groups.of_face[f]), has = chains.find(groups.of_face[f]);
    if (has != chains.end() && (had == chains_before.end() || has->second > had->second)) kept[f] = 1;
  }
}

}  // namespace skinforge
