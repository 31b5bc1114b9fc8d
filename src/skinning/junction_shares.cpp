#include "skinning/junction_shares.h"

#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <limits>

#include "base/error.h"
#include "base/expect.h"
#include "base/parallel.h"

namespace skinforge {
namespace {

constexpr double kSwitchWidth =
    0.1;  // ours: of the mean edge; well below an edge, so the nearer surface wins clearly
constexpr double kShortEdge = 1e-3;  // ours: of the mean edge; shorter edges weigh no more than this one

// New vertices, numbered; -1 for preserved ones.
struct NewVertices {
  std::vector<VertexId> list;
  std::vector<std::int32_t> number;
};

NewVertices number_new_vertices(const ResultSurface& result) {
  NewVertices found;
  found.number.assign(result.origins.size(), -1);
  for (std::size_t v = 0; v < result.origins.size(); ++v) {
    if (!result.origins[v].is_new()) continue;
    found.number[v] = static_cast<std::int32_t>(found.list.size());
    found.list.push_back(VertexId(v));
  }
  return found;
}

double edge_length(const ResultSurface& result, VertexId a, VertexId b) {
  return (result.positions[a.index()] - result.positions[b.index()]).norm();
}

double mean_edge_at(const ResultSurface& result, std::span<const VertexId> vertices) {
  double sum = 0;
  std::size_t count = 0;
  for (const VertexId v : vertices)
    for (const VertexId n : result.graph->of(v)) {
      sum += edge_length(result, v, n);
      ++count;
    }
  return count == 0 ? 0 : sum / static_cast<double>(count);
}

// New vertices that a chain of new vertices links to a preserved one.
std::vector<bool> touches_preserved(const ResultSurface& result, const NewVertices& fresh) {
  std::vector<bool> reached(fresh.list.size(), false);
  std::vector<VertexId> open;
  const auto reach = [&](VertexId v) {
    const auto i = fresh.number[v.index()];
    if (i < 0 || reached[i]) return;
    reached[i] = true;
    open.push_back(v);
  };
  for (const VertexId v : fresh.list)
    for (const VertexId n : result.graph->of(v))
      if (fresh.number[n.index()] < 0) reach(v);
  while (!open.empty()) {
    const VertexId v = open.back();
    open.pop_back();
    for (const VertexId n : result.graph->of(v)) reach(n);
  }
  return reached;
}

// r_k of every new vertex, one column a source; rows of clusters that touch nothing stay 0.
Eigen::MatrixXd harmonic_ramps(const ResultSurface& result, const NewVertices& fresh, double mean_edge,
                               std::size_t source_count) {
  const auto n = static_cast<Eigen::Index>(fresh.list.size());
  const auto bound = touches_preserved(result, fresh);
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(n, static_cast<Eigen::Index>(source_count));
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index i = 0; i < n; ++i) {
    double diagonal = bound[i] ? 0 : 1;
    for (const VertexId to : result.graph->of(fresh.list[i])) {
      if (!bound[i]) continue;
      const double length = std::max(edge_length(result, fresh.list[i], to), kShortEdge * mean_edge);
      const double weight = mean_edge > 0 ? mean_edge / length : 1;
      diagonal += weight;
      const auto j = fresh.number[to.index()];
      if (j >= 0)
        entries.emplace_back(i, j, -weight);
      else
        right(i, static_cast<Eigen::Index>(result.origins[to.index()].source.index())) += weight;
    }
    entries.emplace_back(i, i, diagonal);
  }
  Eigen::SparseMatrix<double> laplacian(n, n);
  laplacian.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(laplacian);
  if (solver.info() != Eigen::Success)
    throw Error(ExitCode::StageFailed, "the harmonic system over the junction could not be factorised");
  Eigen::MatrixXd ramps = solver.solve(right);
  if (!ramps.allFinite())
    throw Error(ExitCode::StageFailed, "the harmonic system over the junction has no finite solution");
  return ramps.cwiseMax(0.0).cwiseMin(1.0);
}

double presence_at(const SourceSurface& source, const ClosestPoint& at) {
  const auto& triangle = source.triangles->triangles[at.triangle];
  double presence = 0;
  for (int i = 0; i < 3; ++i) presence += at.barycentric[i] * source.presence[triangle[i].index()];
  return std::clamp(presence, 0.0, 1.0);
}

// Divides by the sum; false (unchanged) when there is nothing to divide.
bool normalise(Eigen::VectorXd& values) {
  const double sum = values.sum();
  if (!(sum > 0)) return false;
  values /= sum;
  return true;
}

// Factors of one new vertex: `closest` has one entry a source, `ramp` is r_k (all 0: the vertex touches
// nothing).
Eigen::VectorXd factors_at(std::span<const SourceSurface> sources, const std::vector<ClosestPoint>& closest,
                           const Eigen::VectorXd& ramp, double switch_width) {
  const bool floating = ramp.maxCoeff() <= 0;
  bool by_distance = floating;
  Eigen::VectorXd near = Eigen::VectorXd::Zero(ramp.size()), present = near;
  for (Eigen::Index k = 0; k < ramp.size(); ++k) {
    if (closest[k].triangle < 0) continue;
    const double d = closest[k].distance;
    near[k] = 1 / (d * d + switch_width * switch_width + std::numeric_limits<double>::min());
    present[k] = presence_at(sources[k], closest[k]);
    if (!floating) by_distance = sources[k].attached;  // the last one involved is the youngest
  }
  const Eigen::VectorXd reach = floating ? Eigen::VectorXd::Ones(ramp.size()).eval() : ramp;
  Eigen::VectorXd factor = (by_distance ? near : present).cwiseProduct(reach);
  if (normalise(factor)) return factor;
  factor = ramp;  // no source is present here: the borders alone decide
  if (normalise(factor)) return factor;
  return Eigen::VectorXd::Unit(ramp.size(), 0);
}

}  // namespace

JunctionShares junction_shares(const ResultSurface& result, std::span<const SourceSurface> sources) {
  SF_EXPECT(result.positions.size() == result.origins.size() && !sources.empty());
  const NewVertices fresh = number_new_vertices(result);
  const double mean_edge = mean_edge_at(result, fresh.list);
  const Eigen::MatrixXd ramps = harmonic_ramps(result, fresh, mean_edge, sources.size());

  JunctionShares shares;
  shares.new_vertices = fresh.list;
  shares.factor.assign(sources.size(), std::vector<double>(result.positions.size(), 0));
  shares.closest.assign(sources.size(), std::vector<ClosestPoint>(fresh.list.size()));
  for (std::size_t v = 0; v < result.origins.size(); ++v)
    if (!result.origins[v].is_new()) shares.factor[result.origins[v].source.index()][v] = 1;

  parallel_for(fresh.list.size(), [&](std::size_t i) {
    const Eigen::VectorXd ramp = ramps.row(static_cast<Eigen::Index>(i));
    const std::size_t v = fresh.list[i].index();
    std::vector<ClosestPoint> closest(sources.size());
    for (std::size_t k = 0; k < sources.size(); ++k)
      if (ramp[static_cast<Eigen::Index>(k)] > 0 || ramp.maxCoeff() <= 0)
        closest[k] = sources[k].bvh->closest(result.positions[v]);
    const Eigen::VectorXd factor = factors_at(sources, closest, ramp, kSwitchWidth * mean_edge);
    for (std::size_t k = 0; k < sources.size(); ++k) {
      shares.factor[k][v] = factor[static_cast<Eigen::Index>(k)];
      if (shares.factor[k][v] > 0) shares.closest[k][i] = closest[k];
    }
  });
  return shares;
}

}  // namespace skinforge
