#include "surface/tube_path.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace skinforge {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

double squared(double x) {
  return x * x;
}

// How much the border at a stack's middle is no corner: 0 at 90 degrees and below, 1 where it is straight.
double flatness(double angle) {
  constexpr double kCorner = std::numbers::pi / 2;
  return squared(std::max(0.0, angle - kCorner) / kCorner);
}

// How sharply the border turns in at a vertex that a column ends at: 0 where either side keeps 45 degrees, 1
// where nothing is left.
double sharpness(double angle) {
  constexpr double kCorner = std::numbers::pi / 2;
  return squared(std::max(0.0, kCorner - angle) / kCorner);
}

int around(int i, int n) {
  return ((i % n) + n) % n;
}

double theta_at(const std::vector<double>& theta, int i) {
  const int n = static_cast<int>(theta.size());
  return theta[static_cast<std::size_t>(around(i, n))] + std::floor(static_cast<double>(i) / n);
}

bool is_stack(TubeOpKind kind) {
  return kind == TubeOpKind::StackA || kind == TubeOpKind::StackB;
}

}  // namespace

TubePaths::TubePaths(const TubeSide& a, const TubeSide& b, int deepest, const TubeOptions& options, int apart)
    : a_(a),
      b_(b),
      n_(static_cast<int>(a.theta.size())),
      m_(static_cast<int>(b.theta.size())),
      deepest_(deepest),
      options_(options),
      apart_(apart),
      spacing_(1.0 / std::max(n_, m_)) {}

std::size_t TubePaths::name(int i, int j, int t, int since) const {
  return static_cast<std::size_t>(((i * (stretch_.edges_b + 1) + j) * 2 + t) * (apart_ + 1) + since);
}

double TubePaths::skew(int i, int j) const {
  return squared((theta_at(a_.theta, stretch_.first_a + i) - theta_at(b_.theta, stretch_.first_b + j)) /
                 spacing_);
}

double TubePaths::stack_a(int i, int j, int depth) const {
  double inside = 0;
  for (int k = 1; k < 2 * depth; ++k) inside += 0.5 * skew(i + k, j);
  return inside + options_.stack_cost +
         options_.corner_cost *
             flatness(a_.angle[static_cast<std::size_t>(around(stretch_.first_a + i + depth, n_))]);
}

double TubePaths::stack_b(int i, int j, int depth) const {
  double inside = 0;
  for (int k = 1; k < 2 * depth; ++k) inside += 0.5 * skew(i, j + k);
  return inside + options_.stack_cost +
         options_.corner_cost *
             flatness(b_.angle[static_cast<std::size_t>(around(stretch_.first_b + j + depth, m_))]);
}

void TubePaths::offer(int i, int j, int t, int since, double cost, TubeOp op, int since_before) {
  const double sharp = sharpness(a_.angle[static_cast<std::size_t>(around(stretch_.first_a + i, n_))]) +
                       sharpness(b_.angle[static_cast<std::size_t>(around(stretch_.first_b + j, m_))]);
  const double total = cost + skew(i, j) + options_.notch_cost * sharp;
  State& state = states_[name(i, j, t, since)];
  if (total < state.cost) state = {total, op, since_before};
}

void TubePaths::go_on(int i, int j, int t, int since) {
  const double cost = states_[name(i, j, t, since)].cost;
  if (cost == kNever) return;
  const int n = stretch_.edges_a, m = stretch_.edges_b;
  const auto on_a = [&](int k) { return around(stretch_.first_a + k, n_); };
  const auto on_b = [&](int k) { return around(stretch_.first_b + k, m_); };
  if (i < n && j < m)
    offer(i + 1, j + 1, t, std::min(since + 1, apart_), cost, {TubeOpKind::Match, 0, 0}, since);
  if (t < stretch_.triangles && i < n)
    offer(i + 1, j, 1, since, cost + options_.triangle_cost, {TubeOpKind::TriangleA, 1, on_a(i)}, since);
  if (t < stretch_.triangles && j < m)
    offer(i, j + 1, 1, since, cost + options_.triangle_cost, {TubeOpKind::TriangleB, 1, on_b(j)}, since);
  if (since < apart_) return;
  for (int depth = 1; depth <= deepest_; ++depth) {
    if (i + 2 * depth <= n)
      offer(i + 2 * depth, j, t, 0, cost + stack_a(i, j, depth), {TubeOpKind::StackA, depth, on_a(i + depth)},
            since);
    if (j + 2 * depth <= m)
      offer(i, j + 2 * depth, t, 0, cost + stack_b(i, j, depth), {TubeOpKind::StackB, depth, on_b(j + depth)},
            since);
  }
}

void TubePaths::solve(const TubeStretch& stretch) {
  stretch_ = stretch;
  states_.assign(name(stretch.edges_a, stretch.edges_b, 1, apart_) + 1, State{kNever, {}, 0});
  states_[name(0, 0, 0, stretch.since)].cost = 0;
  for (int i = 0; i <= stretch.edges_a; ++i)
    for (int j = 0; j <= stretch.edges_b; ++j)
      for (int t = 0; t <= stretch.triangles; ++t)
        for (int since = 0; since <= apart_; ++since) go_on(i, j, t, since);
}

std::optional<TubePath> TubePaths::cheapest(int since) const {
  int i = stretch_.edges_a, j = stretch_.edges_b, t = stretch_.triangles;
  const auto cost = [&](int s) { return states_[name(i, j, t, s)].cost; };
  for (int s = since + 1; s <= apart_; ++s)
    if (cost(s) < cost(since)) since = s;
  if (cost(since) == kNever) return std::nullopt;
  TubePath path{{}, cost(since)};
  while (i > 0 || j > 0) {
    const State& state = states_[name(i, j, t, since)];
    const TubeOp op = state.op;
    path.ops.push_back(op);
    const int edges = op.kind == TubeOpKind::Match ? 1 : op.depth * (is_stack(op.kind) ? 2 : 1);
    if (op.kind != TubeOpKind::StackB && op.kind != TubeOpKind::TriangleB) i -= edges;
    if (op.kind != TubeOpKind::StackA && op.kind != TubeOpKind::TriangleA) j -= edges;
    if (op.kind == TubeOpKind::TriangleA || op.kind == TubeOpKind::TriangleB) --t;
    since = state.since_before;
  }
  std::reverse(path.ops.begin(), path.ops.end());
  return path;
}

}  // namespace skinforge
