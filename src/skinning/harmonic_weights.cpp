#include "skinning/harmonic_weights.h"

#include <algorithm>
#include <cmath>

#include "base/expect.h"
#include "base/parallel.h"
#include "geometry/vertex_sets.h"

namespace skinforge {
namespace {

// A connected set of free vertices and everything around it.
struct Region {
  std::vector<VertexId> vertices;       ///< free, rising
  std::vector<std::int32_t> triangles;  ///< that have one of them, rising
  std::vector<JointId> joints;          ///< of the handles around it, rising
  std::vector<double> solution;         ///< [vertex][joint]
};

class Solver {
 public:
  Solver(std::span<const Vec3> positions, std::span<const VertexTriangle> triangles, const Handles& handles)
      : triangles_(triangles), handles_(handles), cotangents_(cotangent_weights(positions, triangles)) {}

  HarmonicWeights solve() {
    find_regions();
    parallel_for(regions_.size(), [&](std::size_t r) { solve(regions_[r]); });
    return gather();
  }

 private:
  bool is_free(VertexId v) const { return !handles_[v.index()].is_valid(); }

  void find_regions() {
    VertexSets sets(handles_.size());
    for (const VertexTriangle& t : triangles_)
      for (std::size_t k = 0; k < 3; ++k)
        if (is_free(t[k]) && is_free(t[(k + 1) % 3])) sets.join(t[k], t[(k + 1) % 3]);
    region_of_.assign(handles_.size(), -1);
    local_.assign(handles_.size(), -1);
    for (std::size_t v = 0; v < handles_.size(); ++v) {
      if (handles_[v].is_valid()) continue;
      const std::size_t root = sets.find(VertexId(v)).index();
      if (region_of_[root] < 0) {
        region_of_[root] = static_cast<std::int32_t>(regions_.size());
        regions_.emplace_back();
      }
      region_of_[v] = region_of_[root];
      Region& region = regions_[static_cast<std::size_t>(region_of_[v])];
      local_[v] = static_cast<std::int32_t>(region.vertices.size());
      region.vertices.emplace_back(v);
    }
    for (std::size_t f = 0; f < triangles_.size(); ++f) add_triangle(f);
    for (Region& region : regions_) {
      std::sort(region.joints.begin(), region.joints.end());
      region.joints.erase(std::unique(region.joints.begin(), region.joints.end()), region.joints.end());
    }
  }

  // A triangle may touch several regions, at corners that handles part.
  void add_triangle(std::size_t f) {
    for (const VertexId v : triangles_[f]) {
      if (!is_free(v)) continue;
      Region& region = regions_[static_cast<std::size_t>(region_of_[v.index()])];
      if (!region.triangles.empty() && region.triangles.back() == static_cast<std::int32_t>(f)) continue;
      region.triangles.push_back(static_cast<std::int32_t>(f));
      for (const VertexId other : triangles_[f])
        if (!is_free(other) && (region.joints.empty() || region.joints.back() != handles_[other.index()]))
          region.joints.push_back(handles_[other.index()]);
    }
  }

  void solve(Region& region) const {
    const std::size_t n = region.vertices.size(), m = region.joints.size();
    if (m == 0) return;
    region.solution.assign(n * m, m == 1 ? 1.0 : 0.0);
    if (m == 1) return;  // one handle around: constant
    std::vector<VertexTriangle> triangles;
    std::vector<std::array<double, 3>> weights;
    for (const std::int32_t f : region.triangles) {
      triangles.push_back(triangles_[static_cast<std::size_t>(f)]);
      weights.push_back(cotangents_.half_cotangents[static_cast<std::size_t>(f)]);
      add_to_right_side(region, triangles.back(), weights.back());
    }
    // Corners of other regions count as given: no edge leads there, so their entries would be zero.
    std::vector<std::int32_t> local = local_of(region, triangles);
    for (std::size_t i = 0; i < triangles.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k) triangles[i][k] = VertexId(3 * i + k);
    SparseFactor(laplacian_block(triangles, weights, local, n)).solve(region.solution, m);
  }

  // Row of each corner of `triangles` in this region, -1 for the others. One entry a corner, so that no table
  // over all vertices is needed for each region.
  std::vector<std::int32_t> local_of(const Region& region, std::span<const VertexTriangle> triangles) const {
    std::vector<std::int32_t> local;
    local.reserve(3 * triangles.size());
    const std::int32_t own = region_of_[region.vertices.front().index()];
    for (const VertexTriangle& t : triangles)
      for (const VertexId v : t) local.push_back(region_of_[v.index()] == own ? local_[v.index()] : -1);
    return local;
  }

  // Edges between a free and a held vertex bring the held one's value to the right side.
  void add_to_right_side(Region& region, const VertexTriangle& t,
                         const std::array<double, 3>& weights) const {
    const std::int32_t own = region_of_[region.vertices.front().index()];
    for (std::size_t k = 0; k < 3; ++k)
      for (const auto& [a, b] :
           {std::pair(t[(k + 1) % 3], t[(k + 2) % 3]), std::pair(t[(k + 2) % 3], t[(k + 1) % 3])}) {
        if (region_of_[a.index()] != own || is_free(b)) continue;
        const auto at = std::lower_bound(region.joints.begin(), region.joints.end(), handles_[b.index()]);
        region.solution[static_cast<std::size_t>(local_[a.index()]) * region.joints.size() +
                        static_cast<std::size_t>(at - region.joints.begin())] += weights[k];
      }
  }

  HarmonicWeights gather() const {
    HarmonicWeights result;
    result.degenerate = cotangents_.degenerate;
    std::vector<Influence> row;
    for (std::size_t v = 0; v < handles_.size(); ++v) {
      row.clear();
      if (handles_[v].is_valid())
        row.push_back({handles_[v], 1.0});
      else
        fill_row(v, row);
      if (row.empty()) result.unreached.emplace_back(v);
      for (const Influence& influence : row) {
        result.least = std::min(result.least, influence.weight);
        result.largest = std::max(result.largest, influence.weight);
      }
      result.weights.push_row(row);
    }
    return result;
  }

  void fill_row(std::size_t v, std::vector<Influence>& row) const {
    const Region& region = regions_[static_cast<std::size_t>(region_of_[v])];
    const std::size_t m = region.joints.size(), begin = static_cast<std::size_t>(local_[v]) * m;
    for (std::size_t k = 0; k < m; ++k)
      if (region.solution[begin + k] != 0) row.push_back({region.joints[k], region.solution[begin + k]});
  }

  std::span<const VertexTriangle> triangles_;
  const Handles& handles_;
  CotangentWeights cotangents_;
  std::vector<Region> regions_;
  std::vector<std::int32_t> region_of_, local_;  ///< per vertex; -1 where a handle holds it
};

}  // namespace

HarmonicWeights harmonic_weights(std::span<const Vec3> positions, std::span<const VertexTriangle> triangles,
                                 const Handles& handles) {
  SF_EXPECT(handles.size() == positions.size());
  return Solver(positions, triangles, handles).solve();
}

}  // namespace skinforge
