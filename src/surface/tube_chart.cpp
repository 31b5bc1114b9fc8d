#include "surface/tube_chart.h"

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <queue>
#include <set>

namespace skinforge {
namespace {

constexpr int kBands = 32;  // ours: of theta, to find triangles by

using DirectedEdge = std::pair<std::int32_t, std::int32_t>;

// Cotangent weights, at least a thousandth of the largest angle's one: positive, so maxima lie on borders.
std::map<DirectedEdge, double> edge_weights(const TrianglePatch& patch) {
  constexpr double kLeast = 1e-3;
  std::map<DirectedEdge, double> weights;
  for (const Triangle& t : patch.triangles)
    for (int k = 0; k < 3; ++k) {
      const Vec3& apex = patch.positions[t[(k + 2) % 3]];
      const Vec3 p = patch.positions[t[k]] - apex, q = patch.positions[t[(k + 1) % 3]] - apex;
      const double area = p.cross(q).norm();
      weights[std::minmax(t[k], t[(k + 1) % 3])] += area > 0 ? 0.5 * p.dot(q) / area : 0;
    }
  for (auto& [edge, weight] : weights) weight = std::clamp(weight, kLeast, 1 / kLeast);
  return weights;
}

std::map<DirectedEdge, std::int32_t> triangle_of_half_edge(const TrianglePatch& patch) {
  std::map<DirectedEdge, std::int32_t> found;
  for (std::size_t i = 0; i < patch.triangles.size(); ++i)
    for (int k = 0; k < 3; ++k)
      found[{patch.triangles[i][k], patch.triangles[i][(k + 1) % 3]}] = static_cast<std::int32_t>(i);
  return found;
}

// Half edges that a walk over neighbouring triangles crosses from the first edge of A to any edge of B:
// across them theta is one less. Empty when there is no way.
std::vector<DirectedEdge> cut_across(const TrianglePatch& patch,
                                     const std::map<DirectedEdge, std::int32_t>& triangles,
                                     const IndexLoop& a, const std::set<DirectedEdge>& edges_of_b) {
  const auto first = triangles.find({a[0], a[1]});
  if (first == triangles.end()) return {};
  std::map<std::int32_t, DirectedEdge> entered = {{first->second, {a[0], a[1]}}};  // by which own half edge
  std::queue<std::int32_t> open({first->second});
  while (!open.empty()) {
    const std::int32_t t = open.front();
    open.pop();
    for (int k = 0; k < 3; ++k) {
      const DirectedEdge edge{patch.triangles[t][k], patch.triangles[t][(k + 1) % 3]};
      if (edges_of_b.contains(edge)) {
        std::vector<DirectedEdge> crossed = {edge};
        for (std::int32_t back = t;;) {
          const DirectedEdge in = entered.at(back);
          crossed.push_back({in.second, in.first});  // as seen from before it
          if (in == DirectedEdge{a[0], a[1]}) return crossed;
          back = triangles.at({in.second, in.first});
        }
      }
      const auto next = triangles.find({edge.second, edge.first});
      if (next != triangles.end() &&
          entered.try_emplace(next->second, DirectedEdge{edge.second, edge.first}).second)
        open.push(next->second);
    }
  }
  return {};
}

// Solves sum over edges of w (f_j - f_i + step_ij)^2 -> min with some values given.
std::optional<Eigen::VectorXd> harmonic(std::size_t count, const std::map<DirectedEdge, double>& weights,
                                        const std::map<DirectedEdge, double>& step,
                                        const std::vector<std::optional<double>>& given) {
  Eigen::VectorXd right = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(count));
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](std::int32_t i, std::int32_t j, double w, double jump) {
    if (given[i]) return;
    entries.emplace_back(i, i, w);
    right[i] += w * jump;
    if (given[j])
      right[i] += w * *given[j];
    else
      entries.emplace_back(i, j, -w);
  };
  for (const auto& [edge, w] : weights) {
    const auto found = step.find(edge);
    const double jump = found == step.end() ? 0 : found->second;
    add(edge.first, edge.second, w, jump);
    add(edge.second, edge.first, w, -jump);
  }
  for (std::size_t v = 0; v < count; ++v)
    if (given[v]) entries.emplace_back(v, v, 1), right[static_cast<Eigen::Index>(v)] = *given[v];
  Eigen::SparseMatrix<double> system(static_cast<Eigen::Index>(count), static_cast<Eigen::Index>(count));
  system.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(system);
  if (solver.info() != Eigen::Success) return std::nullopt;
  const Eigen::VectorXd f = solver.solve(right);
  if (!f.allFinite()) return std::nullopt;
  return f;
}

// Theta along a loop from its values and the jumps of its edges; none unless it rises by one turn.
std::optional<std::vector<double>> along(const IndexLoop& loop, const Eigen::VectorXd& f,
                                         const std::map<DirectedEdge, double>& jump) {
  std::vector<double> theta = {f[loop[0]]};
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const std::int32_t i = loop[k], j = loop[(k + 1) % loop.size()];
    const auto found = jump.find(std::minmax(i, j));
    const double own = found == jump.end() ? 0 : found->second;
    const double next = theta.back() + f[j] - f[i] + (i < j ? own : -own);
    if (!(next > theta.back())) return std::nullopt;
    theta.push_back(next);
  }
  if (std::abs(theta.back() - theta.front() - 1) > 1e-6) return std::nullopt;
  theta.pop_back();
  const double whole = std::floor(theta.front());
  for (double& t : theta) t -= whole;
  return theta;
}

}  // namespace

std::optional<TubeChart> TubeChart::make(const TrianglePatch& patch, const IndexLoop& a, const IndexLoop& b) {
  TubeChart chart(patch);
  if (!chart.solve(a, b)) return std::nullopt;
  chart.sort_into_bands();
  return chart;
}

bool TubeChart::solve(const IndexLoop& a, const IndexLoop& b) {
  const auto weights = edge_weights(*patch_);
  const auto triangles = triangle_of_half_edge(*patch_);
  std::set<DirectedEdge> edges_of_b;
  for (std::size_t k = 0; k < b.size(); ++k) edges_of_b.insert({b[(k + 1) % b.size()], b[k]});
  const std::vector<DirectedEdge> cut = cut_across(*patch_, triangles, a, edges_of_b);
  if (cut.empty()) return false;
  std::map<DirectedEdge, double> jump;  // theta grows by this more than its values from the lower vertex on
  for (const auto& [from, to] : cut) jump[std::minmax(from, to)] = from < to ? -1 : 1;

  const std::size_t count = patch_->positions.size();
  std::vector<std::optional<double>> ends(count), one(count), used(count, 0.0);
  for (const Triangle& t : patch_->triangles)
    for (const std::int32_t v : t) used[v].reset();
  ends = one = used;
  for (const std::int32_t v : a) ends[v] = 0;
  for (const std::int32_t v : b) ends[v] = 1;
  one[a[0]] = 0;
  const auto u = harmonic(count, weights, {}, ends);
  const auto f = harmonic(count, weights, jump, one);
  if (!u || !f) return false;
  const auto theta_a = along(a, *f, jump), theta_b = along(b, *f, jump);
  if (!theta_a || !theta_b) return false;
  theta_a_ = *theta_a;
  theta_b_ = *theta_b;
  for (const Triangle& t : patch_->triangles) {
    auto& corners = corners_.emplace_back();
    for (int k = 0; k < 3; ++k) {
      corners[k].u = (*u)[t[k]];
      if (k == 0) {
        corners[k].theta = (*f)[t[0]];
        continue;
      }
      const auto found = jump.find(std::minmax(t[k - 1], t[k]));
      const double own = found == jump.end() ? 0 : found->second;
      corners[k].theta = corners[k - 1].theta + (*f)[t[k]] - (*f)[t[k - 1]] + (t[k - 1] < t[k] ? own : -own);
    }
    const double whole = std::floor(std::min({corners[0].theta, corners[1].theta, corners[2].theta}));
    for (Corner& corner : corners) corner.theta -= whole;
  }
  return true;
}

// A triangle stands in every band that its thetas reach; they begin in [0, 1) and may end beyond 1.
void TubeChart::sort_into_bands() {
  bands_.resize(kBands);
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const auto& c = corners_[i];
    const double low = std::min({c[0].theta, c[1].theta, c[2].theta});
    const double high = std::max({c[0].theta, c[1].theta, c[2].theta});
    const int first = static_cast<int>(std::floor(low * kBands));
    const int last = std::min(static_cast<int>(std::floor(high * kBands)), first + kBands - 1);
    for (int band = first; band <= last; ++band)
      bands_[static_cast<std::size_t>(band % kBands)].push_back(static_cast<std::int32_t>(i));
  }
}

std::vector<double> TubeChart::lengths(int count) const {
  std::vector<double> area(static_cast<std::size_t>(count), 0), flux(area);
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const Triangle& t = patch_->triangles[i];
    const Vec3 e1 = patch_->positions[t[1]] - patch_->positions[t[0]];
    const Vec3 e2 = patch_->positions[t[2]] - patch_->positions[t[0]];
    const Vec3 cross = e1.cross(e2);
    if (!(cross.norm() > 0)) continue;
    const double d1 = corners_[i][1].u - corners_[i][0].u, d2 = corners_[i][2].u - corners_[i][0].u;
    const Vec3 gradient = (d1 * e2 - d2 * e1).cross(cross) / cross.squaredNorm();
    const double low = std::min({corners_[i][0].u, corners_[i][1].u, corners_[i][2].u});
    const double high = std::max({corners_[i][0].u, corners_[i][1].u, corners_[i][2].u});
    for (int k = 0; k < count; ++k) {  // its area, spread evenly over its range of u
      const double begin = std::max(low, static_cast<double>(k) / count);
      const double end = std::min(high, static_cast<double>(k + 1) / count);
      if (end <= begin) continue;
      const double share = 0.5 * cross.norm() * (end - begin) / (high - low);
      area[k] += share;
      flux[k] += share * gradient.norm();
    }
  }
  std::vector<double> result = {0};
  for (int k = 0; k < count; ++k)
    result.push_back(result.back() + (flux[k] > 0 ? area[k] / flux[k] / count : 0));
  return result;
}

Vec3 TubeChart::at(double u, double theta) const {
  theta -= std::floor(theta);
  const auto& band = bands_[std::min(static_cast<std::size_t>(theta * kBands), bands_.size() - 1)];
  Vec3 best = Vec3::Zero();
  double least = std::numeric_limits<double>::infinity();
  for (const std::int32_t i : band)
    for (const double turn : {0.0, 1.0}) {
      const auto& c = corners_[i];
      const double x1 = c[1].theta - c[0].theta, y1 = c[1].u - c[0].u, x2 = c[2].theta - c[0].theta,
                   y2 = c[2].u - c[0].u, x = theta + turn - c[0].theta, y = u - c[0].u;
      const double area = x1 * y2 - x2 * y1;
      if (area == 0) continue;
      const double s = (x * y2 - x2 * y) / area, t = (x1 * y - x * y1) / area;
      const double outside = std::max({-s, -t, s + t - 1, 0.0});
      if (outside >= least) continue;
      least = outside;
      const Triangle& v = patch_->triangles[i];
      best =
          (1 - s - t) * patch_->positions[v[0]] + s * patch_->positions[v[1]] + t * patch_->positions[v[2]];
    }
  return best;
}

}  // namespace skinforge
