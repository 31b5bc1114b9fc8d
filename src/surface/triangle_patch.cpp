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
    std::int32_t largest = -1;
    for (const Triangle& t : triangles) largest = std::max({largest, t[0], t[1], t[2]});
    begin_.assign(static_cast<std::size_t>(largest) + 2, 0);
    for (const Triangle& t : triangles)
      for (const std::int32_t v : t) ++begin_[v + 1];
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    all_.resize(3 * triangles.size());
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    for (const Triangle& t : triangles)
      for (int k = 0; k < 3; ++k) all_[next[t[k]]++] = {{t[k], t[(k + 1) % 3]}, t[(k + 2) % 3]};
    sort_and_thin();
  }

  std::size_t size() const { return all_.size(); }
  const HalfEdge& edge(std::size_t i) const { return all_[i].edge; }
  std::int32_t apex(std::size_t i) const { return all_[i].apex; }

  // None where no triangle has it.
  std::optional<std::size_t> find(const HalfEdge& edge) const {
    const auto begin = at(edge.first), end = at(edge.first + 1);
    const auto found = std::lower_bound(
        begin, end, edge.second, [](const Entry& e, std::int32_t wanted) { return e.edge.second < wanted; });
    if (found == end || found->edge.second != edge.second) return std::nullopt;
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
  std::vector<Entry>::const_iterator at(std::int32_t vertex) const {
    return all_.begin() + static_cast<std::ptrdiff_t>(begin_[vertex]);
  }

  // Within each vertex, whose half-edges stand together already.
  void sort_and_thin() {
    std::size_t kept = 0;
    for (std::size_t v = 0; v + 1 < begin_.size(); ++v) {
      const auto begin = all_.begin() + static_cast<std::ptrdiff_t>(begin_[v]),
                 end = all_.begin() + static_cast<std::ptrdiff_t>(begin_[v + 1]);
      std::stable_sort(begin, end,
                       [](const Entry& a, const Entry& b) { return a.edge.second < b.edge.second; });
      begin_[v] = kept;
      for (auto e = begin; e != end; ++e) {
        if (e + 1 != end && (e + 1)->edge == e->edge) continue;
        all_[kept++] = *e;
      }
    }
    begin_.back() = kept;
    all_.resize(kept);
  }

  std::vector<Entry> all_;
  std::vector<std::size_t> begin_;  // of each vertex in `all_`, and the end
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
