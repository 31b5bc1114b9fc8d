#include "skinning/weight_transfer.h"

#include <algorithm>

#include "base/expect.h"
#include "base/parallel.h"
#include "skinning/weight_rows.h"

namespace skinforge {
namespace {

using Row = std::vector<Influence>;

constexpr double kSelfShare =
    0.5;  // ours: half own row, half its neighbours'; the usual damped Laplacian step
constexpr int kNeighbourRings = 2;  // ours: how far the preserved surface is compared with the junction

Row row_at(const SourceSurface& source, const ClosestPoint& at) {
  if (at.triangle < 0) return {};
  return retargeted_row(
      interpolate_row(*source.weights, source.triangles->triangles[at.triangle], at.barycentric),
      *source.map);
}

// Rows of the new vertices, mixed but not cut yet, so that smoothing sees all influences.
Row blended_row(std::span<const SourceSurface> sources, const JunctionShares& shares, std::size_t i) {
  std::vector<Row> rows(sources.size());
  std::vector<RowShare> mix;
  for (std::size_t k = 0; k < sources.size(); ++k) {
    const double factor = shares.factor[k][shares.new_vertices[i].index()];
    if (!(factor > 0)) continue;
    rows[k] = row_at(sources[k], shares.closest[k][i]);
    mix.push_back({rows[k], factor});
  }
  return blend_rows(mix, 0);
}

std::vector<Row> initial_rows(const ResultSurface& result, std::span<const SourceSurface> sources,
                              const JunctionShares& shares) {
  std::vector<Row> rows(result.positions.size());
  parallel_chunks(rows.size(), 512, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const VertexOrigin& origin = result.origins[v];
      if (origin.is_new()) continue;
      const SourceSurface& source = sources[origin.source.index()];
      rows[v] = retargeted_row(source.weights->of(origin.vertex), *source.map);
    }
  });
  parallel_for(shares.new_vertices.size(), [&](std::size_t i) {
    rows[shares.new_vertices[i].index()] = blended_row(sources, shares, i);
  });
  return rows;
}

// Takes the row of the neighbour at the shortest edge, ring by ring, until nothing changes.
void fill_along_mesh(const ResultSurface& result, std::vector<Row>& rows, std::vector<VertexId>& empty) {
  for (bool changed = true; changed && !empty.empty();) {
    std::vector<std::pair<VertexId, VertexId>> found;
    for (const VertexId v : empty) {
      VertexId best;
      double best_length = 0;
      for (const VertexId n : result.graph->of(v)) {
        const double length = (result.positions[n.index()] - result.positions[v.index()]).norm();
        if (!rows[n.index()].empty() && (!best.is_valid() || length < best_length)) {
          best = n;
          best_length = length;
        }
      }
      if (best.is_valid()) found.emplace_back(v, best);
    }
    for (const auto& [to, from] : found) rows[to.index()] = rows[from.index()];
    std::erase_if(empty, [&](VertexId v) { return !rows[v.index()].empty(); });
    changed = !found.empty();
  }
}

Row nearest_row_in_space(const ResultSurface& result, const std::vector<Row>& rows, VertexId v) {
  const Row* best = nullptr;
  double best_distance = 0;
  for (std::size_t u = 0; u < rows.size(); ++u) {
    const double distance = (result.positions[u] - result.positions[v.index()]).squaredNorm();
    if (rows[u].empty() || (best && distance >= best_distance)) continue;
    best = &rows[u];
    best_distance = distance;
  }
  return best ? *best : Row{{JointId(0), 1.0}};
}

std::size_t fill_empty_rows(const ResultSurface& result, std::vector<Row>& rows) {
  std::vector<VertexId> empty;
  for (std::size_t v = 0; v < rows.size(); ++v)
    if (rows[v].empty()) empty.push_back(VertexId(v));
  const std::size_t count = empty.size();
  fill_along_mesh(result, rows, empty);
  std::vector<Row> found;
  for (const VertexId v : empty) found.push_back(nearest_row_in_space(result, rows, v));
  for (std::size_t i = 0; i < empty.size(); ++i) rows[empty[i].index()] = std::move(found[i]);
  return count;
}

// One Laplacian step at the new vertices; neighbours count by 1 / edge length. Preserved rows stand still.
void smooth_once(const ResultSurface& result, std::span<const VertexId> new_vertices,
                 std::vector<Row>& rows) {
  std::vector<Row> next(new_vertices.size());
  parallel_for(new_vertices.size(), [&](std::size_t i) {
    const VertexId v = new_vertices[i];
    std::vector<RowShare> mix;
    double sum = 0;
    for (const VertexId n : result.graph->of(v)) {
      const double length = (result.positions[n.index()] - result.positions[v.index()]).norm();
      if (!(length > 0)) continue;
      mix.push_back({rows[n.index()], 1 / length});
      sum += 1 / length;
    }
    mix.push_back({rows[v.index()], sum > 0 ? sum * kSelfShare / (1 - kSelfShare) : 1.0});
    next[i] = blend_rows(mix, 0);
  });
  for (std::size_t i = 0; i < new_vertices.size(); ++i) rows[new_vertices[i].index()] = std::move(next[i]);
}

// Vertices within `rings` edges of a new vertex or of an edge between two sources.
std::vector<bool> near_junction(const ResultSurface& result, int rings) {
  const std::size_t n = result.origins.size();
  std::vector<bool> near(n, false);
  for (std::size_t v = 0; v < n; ++v)
    for (const VertexId u : result.graph->of(VertexId(v)))
      if (result.origins[u.index()].source != result.origins[v].source) near[v] = true;
  for (int ring = 1; ring < rings; ++ring) {
    const std::vector<bool> before = near;
    for (std::size_t v = 0; v < n; ++v)
      for (const VertexId u : result.graph->of(VertexId(v)))
        if (before[u.index()]) near[v] = true;
  }
  return near;
}

// The edges whose steps are compared.
struct ComparedEdges {
  std::vector<std::pair<VertexId, VertexId>> junction;
  std::vector<std::pair<VertexId, VertexId>> neighbours;
};

ComparedEdges compared_edges(const ResultSurface& result) {
  const auto near = near_junction(result, kNeighbourRings);
  ComparedEdges edges;
  for (std::size_t v = 0; v < result.origins.size(); ++v) {
    for (const VertexId u : result.graph->of(VertexId(v))) {
      if (u.index() < v || !(near[v] || near[u.index()])) continue;
      const bool preserved =
          !result.origins[v].is_new() && result.origins[u.index()].source == result.origins[v].source;
      (preserved ? edges.neighbours : edges.junction).emplace_back(VertexId(v), u);
    }
  }
  return edges;
}

template <class RowOf>
WeightSteps largest_steps(const ComparedEdges& edges, const RowOf& row_of) {
  WeightSteps steps;
  for (const auto& [a, b] : edges.junction)
    steps.junction = std::max(steps.junction, row_distance(row_of(a), row_of(b)));
  for (const auto& [a, b] : edges.neighbours)
    steps.neighbours = std::max(steps.neighbours, row_distance(row_of(a), row_of(b)));
  return steps;
}

// `rows` with those of the new vertices cut to the limit.
std::vector<Row> cut_rows(std::vector<Row> rows, std::span<const VertexId> new_vertices, std::size_t limit) {
  for (const VertexId v : new_vertices) rows[v.index()] = normalised_row(std::move(rows[v.index()]), limit);
  return rows;
}

}  // namespace

WeightSteps weight_steps(const SkinWeights& weights, const ResultSurface& result) {
  return largest_steps(compared_edges(result), [&](VertexId v) { return weights.of(v); });
}

TransferredWeights transfer_weights(const ResultSurface& result, std::span<const SourceSurface> sources,
                                    const JunctionShares& shares, const WeightTransferOptions& options) {
  SF_EXPECT(shares.factor.size() == sources.size());
  TransferredWeights transferred;
  std::vector<Row> rows = initial_rows(result, sources, shares);
  transferred.filled_rows = fill_empty_rows(result, rows);

  const ComparedEdges edges = compared_edges(result);
  const auto measure = [&](const std::vector<Row>& r) {
    return largest_steps(edges, [&](VertexId v) -> const Row& { return r[v.index()]; });
  };
  transferred.blended = measure(cut_rows(rows, shares.new_vertices, options.influences));
  for (int pass = 0; pass < options.smoothing_passes; ++pass) smooth_once(result, shares.new_vertices, rows);
  rows = cut_rows(std::move(rows), shares.new_vertices, options.influences);
  transferred.steps = measure(rows);
  for (const Row& row : rows) transferred.weights.push_row(row);
  return transferred;
}

}  // namespace skinforge
