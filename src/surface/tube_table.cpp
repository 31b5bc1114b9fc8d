#include "surface/tube_table.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/expect.h"

namespace skinforge {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr int kMostApart = 2;  // matches between two stacks

double squared(double x) {
  return x * x;
}

// How much the border at a stack's middle is no corner: 0 at 90 degrees and below, 1 where it is straight.
double flatness(double angle) {
  constexpr double kCorner = std::numbers::pi / 2;
  return squared(std::max(0.0, angle - kCorner) / kCorner);
}

class Solver {
 public:
  Solver(const TubeSide& a, const TubeSide& b, int deepest, const TubeOptions& options, int apart)
      : a_(a),
        b_(b),
        n_(static_cast<int>(a.theta.size())),
        m_(static_cast<int>(b.theta.size())),
        deepest_(deepest),
        options_(options),
        apart_(apart),
        spacing_(1.0 / std::max(n_, m_)),
        triangles_((n_ + m_) % 2),
        states_(static_cast<std::size_t>((n_ + 1) * (m_ + 1) * 2 * (apart + 1))) {}

  // The cheapest way from vertex 0 of A and `start` of B once around.
  std::optional<TubeTable> solve(int start) {
    start_ = start;
    std::fill(states_.begin(), states_.end(), State{});
    at(0, 0, 0, apart_).cost = 0;
    for (int i = 0; i <= n_; ++i)
      for (int j = 0; j <= m_; ++j)
        for (int t = 0; t <= triangles_; ++t)
          for (int since = 0; since <= apart_; ++since) go_on(i, j, t, since);
    return best();
  }

 private:
  struct State {
    double cost = kNever;
    TubeOp op;
    int since_before = 0;
  };

  State& at(int i, int j, int t, int since) {
    return states_[static_cast<std::size_t>(((i * (m_ + 1) + j) * 2 + t) * (apart_ + 1) + since)];
  }
  double theta_a(int i) const { return a_.theta[static_cast<std::size_t>(i % n_)] + i / n_; }
  double theta_b(int j) const {
    const int k = start_ + j;
    return b_.theta[static_cast<std::size_t>(((k % m_) + m_) % m_)] + std::floor(static_cast<double>(k) / m_);
  }
  // Of the column end between vertex i of A and vertex j of B.
  double skew(int i, int j) const { return squared((theta_a(i) - theta_b(j)) / spacing_); }

  void go_on(int i, int j, int t, int since) {
    const double cost = at(i, j, t, since).cost;
    if (cost == kNever) return;
    if (i < n_ && j < m_)
      offer(i + 1, j + 1, t, std::min(since + 1, apart_), cost, {TubeOpKind::Match, 0, 0}, since);
    if (t < triangles_ && i < n_)
      offer(i + 1, j, 1, since, cost + options_.triangle_cost, {TubeOpKind::TriangleA, 1, i}, since);
    if (t < triangles_ && j < m_)
      offer(i, j + 1, 1, since, cost + options_.triangle_cost, {TubeOpKind::TriangleB, 1, j}, since);
    if (since < apart_) return;
    for (int depth = 1; depth <= deepest_; ++depth) {
      if (i + 2 * depth <= n_)
        offer(i + 2 * depth, j, t, 0, cost + stack_a(i, j, depth),
              {TubeOpKind::StackA, depth, (i + depth) % n_}, since);
      if (j + 2 * depth <= m_)
        offer(i, j + 2 * depth, t, 0, cost + stack_b(i, j, depth),
              {TubeOpKind::StackB, depth, (start_ + j + depth) % m_}, since);
    }
  }

  double stack_a(int i, int j, int depth) const {
    double inside = 0;
    for (int k = 1; k < 2 * depth; ++k) inside += 0.5 * skew(i + k, j);
    return inside + options_.stack_cost +
           options_.corner_cost * flatness(a_.angle[static_cast<std::size_t>((i + depth) % n_)]);
  }
  double stack_b(int i, int j, int depth) const {
    double inside = 0;
    for (int k = 1; k < 2 * depth; ++k) inside += 0.5 * skew(i, j + k);
    const int middle = (((start_ + j + depth) % m_) + m_) % m_;
    return inside + options_.stack_cost +
           options_.corner_cost * flatness(b_.angle[static_cast<std::size_t>(middle)]);
  }

  void offer(int i, int j, int t, int since, double cost, TubeOp op, int since_before) {
    const double total = cost + skew(i, j);
    State& state = at(i, j, t, since);
    if (total < state.cost) state = {total, op, since_before};
  }

  std::optional<TubeTable> best() {
    int since = 0;
    for (int s = 1; s <= apart_; ++s)
      if (at(n_, m_, triangles_, s).cost < at(n_, m_, triangles_, since).cost) since = s;
    if (at(n_, m_, triangles_, since).cost == kNever) return std::nullopt;
    TubeTable table{
        static_cast<std::size_t>(((start_ % m_) + m_) % m_), {}, at(n_, m_, triangles_, since).cost};
    for (int i = n_, j = m_, t = triangles_; i > 0 || j > 0;) {
      const State& state = at(i, j, t, since);
      TubeOp op = state.op;
      if (op.kind == TubeOpKind::StackB || op.kind == TubeOpKind::TriangleB)
        op.middle = ((op.middle % m_) + m_) % m_;
      table.ops.push_back(op);
      const int edges = op.kind == TubeOpKind::Match ? 1 : op.depth * (is_stack(op.kind) ? 2 : 1);
      if (op.kind != TubeOpKind::StackB && op.kind != TubeOpKind::TriangleB) i -= edges;
      if (op.kind != TubeOpKind::StackA && op.kind != TubeOpKind::TriangleA) j -= edges;
      if (op.kind == TubeOpKind::TriangleA || op.kind == TubeOpKind::TriangleB) --t;
      since = state.since_before;
    }
    std::reverse(table.ops.begin(), table.ops.end());
    return table;
  }

  static bool is_stack(TubeOpKind kind) { return kind == TubeOpKind::StackA || kind == TubeOpKind::StackB; }

  const TubeSide& a_;
  const TubeSide& b_;
  int n_, m_, deepest_;
  const TubeOptions& options_;
  int apart_;
  double spacing_;
  int triangles_;
  int start_ = 0;
  std::vector<State> states_;
};

// The vertex of B nearest in theta to vertex 0 of A; may be negative or beyond, by whole turns.
int nearest_start(const TubeSide& a, const TubeSide& b) {
  const int m = static_cast<int>(b.theta.size());
  int best = 0;
  double least = kNever;
  for (int k = -m; k < 2 * m; ++k) {
    const double turns = std::floor(static_cast<double>(k) / m);
    const double theta = b.theta[static_cast<std::size_t>(((k % m) + m) % m)] + turns;
    if (std::abs(theta - a.theta[0]) < least) least = std::abs(theta - a.theta[0]), best = k;
  }
  return best;
}

}  // namespace

std::optional<TubeTable> solve_tube(const TubeSide& a, const TubeSide& b, int rows,
                                    const TubeOptions& options) {
  SF_EXPECT(a.theta.size() >= 3 && b.theta.size() >= 3);
  SF_EXPECT(a.angle.size() == a.theta.size() && b.angle.size() == b.theta.size());
  const int deepest = std::min(options.deepest, rows - 2);
  const int middle = nearest_start(a, b);
  for (int apart = kMostApart; apart >= 0; --apart) {
    Solver solver(a, b, deepest, options, apart);
    std::optional<TubeTable> best;
    for (int start = middle - options.start_reach; start <= middle + options.start_reach; ++start) {
      auto table = solver.solve(start);
      if (table && (!best || table->cost < best->cost)) best = std::move(table);
    }
    if (best) return best;
  }
  return std::nullopt;
}

}  // namespace skinforge
