#include "deform/poisson_stitch.h"

#include <algorithm>

#include "base/expect.h"
#include "geometry/vertex_sets.h"

namespace skinforge {

PoissonStitcher::PoissonStitcher(std::span<const Vec3> positions, std::span<const VertexTriangle> triangles,
                                 std::span<const VertexId> held)
    : rest_(positions.begin(), positions.end()), triangles_(triangles.begin(), triangles.end()) {
  CotangentWeights weights = cotangent_weights(positions, triangles);
  half_cotangents_ = std::move(weights.half_cotangents);
  degenerate_ = weights.degenerate;
  hold_parts(positions.size(), held);
  local_.assign(positions.size(), 0);
  for (const VertexId v : held_) local_[v.index()] = -1;
  for (std::int32_t& local : local_)
    if (local >= 0) local = static_cast<std::int32_t>(rows_++);
  factor_ = std::make_unique<SparseFactor>(laplacian_block(triangles_, half_cotangents_, local_, rows_));
}

void PoissonStitcher::hold_parts(std::size_t vertex_count, std::span<const VertexId> held) {
  VertexSets parts(vertex_count);
  for (const VertexTriangle& t : triangles_) {
    parts.join(t[0], t[1]);
    parts.join(t[1], t[2]);
  }
  std::vector<bool> has_held(vertex_count, false);
  for (const VertexId v : held) has_held[parts.find(v).index()] = true;
  held_.assign(held.begin(), held.end());
  for (std::size_t v = 0; v < vertex_count; ++v) {
    if (parts.find(VertexId(v)) != VertexId(v) || has_held[v]) continue;
    held_.emplace_back(v);
    ++added_;
  }
  std::sort(held_.begin(), held_.end());
  held_.erase(std::unique(held_.begin(), held_.end()), held_.end());
}

std::vector<Vec3> PoissonStitcher::stitch(std::span<const Mat3> maps, std::span<const Vec3> places) const {
  SF_EXPECT(maps.size() == triangles_.size() && places.size() == rest_.size());
  std::vector<double> block(3 * rows_, 0.0);
  const auto row = [&](VertexId v) {
    return Eigen::Map<Vec3>(block.data() + 3 * static_cast<std::size_t>(local_[v.index()]));
  };
  for (std::size_t f = 0; f < triangles_.size(); ++f) {
    const VertexTriangle& t = triangles_[f];
    const auto is_free = [&](std::size_t k) { return local_[t[k].index()] >= 0; };
    if (!is_free(0) && !is_free(1) && !is_free(2)) continue;
    // Edges as vectors of the mapped rest triangle; the third closes it.
    const Vec3 e2 = maps[f] * (rest_[t[1].index()] - rest_[t[0].index()]);
    const Vec3 e1 = maps[f] * (rest_[t[0].index()] - rest_[t[2].index()]);
    const std::array<Vec3, 3> edge{-e1 - e2, e1, e2};  // entry k runs from corner k + 1 to k + 2
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t from = (k + 1) % 3, to = (k + 2) % 3;
      const double weight = half_cotangents_[f][k];
      const Vec3 pull = weight * edge[k];
      if (is_free(from)) row(t[from]) -= pull;
      if (is_free(to)) row(t[to]) += pull;
      if (is_free(from) && !is_free(to)) row(t[from]) += weight * places[t[to].index()];
      if (is_free(to) && !is_free(from)) row(t[to]) += weight * places[t[from].index()];
    }
  }
  factor_->solve(block, 3);
  std::vector<Vec3> stitched(rest_.size());
  for (std::size_t v = 0; v < stitched.size(); ++v)
    stitched[v] = local_[v] >= 0 ? Vec3(row(VertexId(v))) : places[v];
  return stitched;
}

}  // namespace skinforge
