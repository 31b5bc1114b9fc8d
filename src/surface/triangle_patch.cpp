#include "surface/triangle_patch.h"

#include <algorithm>
#include <numeric>
#include <optional>

namespace skinforge {
namespace {

using HalfEdge = std::pair<std::int32_t, std::int32_t>;

// Half-edges in order, each with the third vertex of its triangle: of the last where several have it.
class HalfEdges {
 public:
  explicit HalfEdges(std::span<const Triangle> triangles) {
    all_.reserve(3 * triangles.size());
    for (const Triangle& t : triangles)
      for (int k = 0; k < 3; ++k) all_.push_back({{t[k], t[(k + 1) % 3]}, t[(k + 2) % 3]});
    std::stable_sort(all_.begin(), all_.end(), [](const auto& a, const auto& b) { return a.edge < b.edge; });
    const auto is_same = [](const auto& a, const auto& b) { return a.edge == b.edge; };
    all_.erase(all_.begin(), std::unique(all_.rbegin(), all_.rend(), is_same).base());
  }

  std::size_t size() const { return all_.size(); }
  const HalfEdge& edge(std::size_t i) const { return all_[i].edge; }
  std::int32_t apex(std::size_t i) const { return all_[i].apex; }

  // None where no triangle has it.
  std::optional<std::size_t> find(const HalfEdge& edge) const {
    const auto found =
        std::lower_bound(all_.begin(), all_.end(), edge,
                         [](const Entry& e, const HalfEdge& wanted) { return e.edge < wanted; });
    if (found == all_.end() || found->edge != edge) return std::nullopt;
    return static_cast<std::size_t>(found - all_.begin());
  }

  // The boundary half-edge that follows one: turn about its head through the triangles of the same fan.
  std::size_t next_boundary(std::size_t i) const {
    const std::int32_t pivot = all_[i].edge.second;
    std::int32_t spoke = all_[i].apex;  // triangle (edge.first, pivot, spoke): go on across (pivot, spoke)
    while (const auto across = find({spoke, pivot})) spoke = all_[*across].apex;
    return *find({pivot, spoke});
  }

 private:
  struct Entry {
    HalfEdge edge;
    std::int32_t apex;
  };
  std::vector<Entry> all_;
};

}  // namespace

std::vector<std::vector<std::int32_t>> boundary_loops(std::span<const Triangle> triangles) {
  const HalfEdges half_edges(triangles);
  std::vector<char> is_open(half_edges.size());  // boundary half-edges not yet walked
  for (std::size_t i = 0; i < is_open.size(); ++i)
    is_open[i] = !half_edges.find({half_edges.edge(i).second, half_edges.edge(i).first});
  std::vector<std::vector<std::int32_t>> loops;
  for (std::size_t start = 0; start < is_open.size(); ++start) {
    if (!is_open[start]) continue;
    std::vector<std::int32_t> loop;
    for (std::size_t i = start; is_open[i]; i = half_edges.next_boundary(i)) {
      is_open[i] = 0;
      loop.push_back(half_edges.edge(i).first);
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
