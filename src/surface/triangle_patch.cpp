#include "surface/triangle_patch.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace skinforge {
namespace {

using HalfEdge = std::pair<std::int32_t, std::int32_t>;

// Boundary half-edges: those whose reverse no triangle has; and for each half-edge its triangle's third
// vertex.
std::map<HalfEdge, std::int32_t> half_edges(std::span<const Triangle> triangles) {
  std::map<HalfEdge, std::int32_t> apex;
  for (const Triangle& t : triangles)
    for (int k = 0; k < 3; ++k) apex[{t[k], t[(k + 1) % 3]}] = t[(k + 2) % 3];
  return apex;
}

// The boundary half-edge that follows `edge`: turn about its head through the triangles of the same fan.
HalfEdge next_boundary(const std::map<HalfEdge, std::int32_t>& apex, HalfEdge edge) {
  const std::int32_t pivot = edge.second;
  std::int32_t spoke = apex.at(edge);  // triangle (edge.first, pivot, spoke): go on across (pivot, spoke)
  while (true) {
    const auto across = apex.find({spoke, pivot});
    if (across == apex.end()) return {pivot, spoke};
    spoke = across->second;
  }
}

}  // namespace

std::vector<std::vector<std::int32_t>> boundary_loops(std::span<const Triangle> triangles) {
  const auto apex = half_edges(triangles);
  std::map<HalfEdge, bool> open;  // boundary half-edges not yet walked
  for (const auto& [edge, third] : apex)
    if (!apex.contains({edge.second, edge.first})) open[edge] = true;
  std::vector<std::vector<std::int32_t>> loops;
  for (auto& [start, unused] : open) {
    if (!unused) continue;
    std::vector<std::int32_t> loop;
    for (HalfEdge edge = start; open.at(edge); edge = next_boundary(apex, edge)) {
      open.at(edge) = false;
      loop.push_back(edge.first);
    }
    loops.push_back(std::move(loop));
  }
  return loops;
}

std::pair<std::vector<std::int32_t>, std::int32_t> triangle_components(std::span<const Triangle> triangles,
                                                                       std::size_t vertex_count) {
  std::vector<std::int32_t> root(vertex_count);
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](std::int32_t v) {
    while (root[v] != v) v = root[v] = root[root[v]];
    return v;
  };
  for (const Triangle& t : triangles)
    for (int k = 1; k < 3; ++k) root[find(t[k])] = find(t[0]);
  std::vector<std::int32_t> label(vertex_count, -1), component;
  std::int32_t count = 0;
  for (const Triangle& t : triangles) {
    std::int32_t& l = label[find(t[0])];
    if (l < 0) l = count++;
    component.push_back(l);
  }
  return {component, count};
}

TrianglePatch without_unused_vertices(const TrianglePatch& patch) {
  std::vector<char> used(patch.positions.size(), 0);
  std::fill(used.begin(), used.begin() + static_cast<std::ptrdiff_t>(patch.fixed), 1);
  for (const Triangle& t : patch.triangles)
    for (const std::int32_t v : t) used[v] = 1;
  TrianglePatch result;
  result.fixed = patch.fixed;
  std::vector<std::int32_t> renamed(patch.positions.size(), -1);
  for (std::size_t v = 0; v < used.size(); ++v) {
    if (!used[v]) continue;
    renamed[v] = static_cast<std::int32_t>(result.positions.size());
    result.positions.push_back(patch.positions[v]);
  }
  for (const Triangle& t : patch.triangles)
    result.triangles.push_back({renamed[t[0]], renamed[t[1]], renamed[t[2]]});
  return result;
}

double loop_length(std::span<const Vec3> loop) {
  double length = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) length += (loop[(i + 1) % loop.size()] - loop[i]).norm();
  return length;
}

}  // namespace skinforge
