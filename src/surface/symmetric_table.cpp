#include "surface/symmetric_table.h"

#include <algorithm>
#include <cmath>

#include "base/expect.h"
#include "surface/tube_path.h"

namespace skinforge {
namespace {

constexpr int kMostApart = 2;  // matches between two stacks, as in `solve_tube`

int around(int i, int n) {
  return ((i % n) + n) % n;
}

double theta_at(const TubeSide& side, int i) {
  const int n = static_cast<int>(side.theta.size());
  return side.theta[static_cast<std::size_t>(around(i, n))] + std::floor(static_cast<double>(i) / n);
}

// Theta at a place counted in half edges.
double theta_at_half(const TubeSide& side, int half) {
  const int low = (half - around(half, 2)) / 2;
  return 0.5 * (theta_at(side, low) + theta_at(side, low + around(half, 2)));
}

// Theta as the mean of both directions from a crossing (in half edges), where it is 0.
TubeSide mirrored_side(const TubeSide& side, int crossing) {
  const int n = static_cast<int>(side.theta.size());
  TubeSide result;
  for (int i = 0; i < n; ++i) {
    result.theta.push_back(0.5 * (theta_at(side, i) - theta_at(side, crossing - i)));
    result.angle.push_back(0.5 * (side.angle[static_cast<std::size_t>(i)] +
                                  side.angle[static_cast<std::size_t>(around(crossing - i, n))]));
  }
  return result;
}

// What stands in a crossing: a column that is its own image, or nothing. Half edges that it uses to either
// side, half its cost, and matches to the next stack on either side at least.
struct Centre {
  std::optional<TubeOp> op;
  int half_a = 0, half_b = 0;
  int apart = 0;

  bool is_triangle() const {
    return op && (op->kind == TubeOpKind::TriangleA || op->kind == TubeOpKind::TriangleB);
  }
};

// `a`, `b`: the crossing in half edges.
std::vector<Centre> centres_at(int a, int b, int n, int m, int deepest, int apart) {
  const bool edge_a = around(a, 2) == 1, edge_b = around(b, 2) == 1;
  const int from_plane = (apart + 1) / 2, from_column = apart / 2;
  if (edge_a && edge_b) return {{TubeOp{TubeOpKind::Match, 0, 0}, 1, 1, from_column}};
  if (edge_a) return {{TubeOp{TubeOpKind::TriangleA, 1, around((a - 1) / 2, n)}, 1, 0, from_plane}};
  if (edge_b) return {{TubeOp{TubeOpKind::TriangleB, 1, around((b - 1) / 2, m)}, 0, 1, from_plane}};
  std::vector<Centre> centres = {{std::nullopt, 0, 0, from_plane}};
  for (int depth = 1; depth <= deepest && 2 * depth <= std::abs(n - m) + 1; ++depth)
    centres.push_back(n > m
                          ? Centre{TubeOp{TubeOpKind::StackA, depth, around(a / 2, n)}, 2 * depth, 0, apart}
                          : Centre{TubeOp{TubeOpKind::StackB, depth, around(b / 2, m)}, 0, 2 * depth, apart});
  return centres;
}

class HalfSolver {
 public:
  // Crossings in half edges: the first of both sides.
  HalfSolver(const TubeSide& a, int crossing_a, const TubeSide& b, int crossing_b, int deepest,
             const TubeOptions& options, int apart)
      : a_(mirrored_side(a, crossing_a)),
        b_(mirrored_side(b, crossing_b)),
        crossing_a_(crossing_a),
        crossing_b_(crossing_b),
        n_(static_cast<int>(a.theta.size())),
        m_(static_cast<int>(b.theta.size())),
        options_(options),
        apart_(apart),
        paths_(a_, b_, deepest, options_, apart),
        first_(centres_at(crossing_a, crossing_b, n_, m_, deepest, apart)),
        last_(centres_at(crossing_a + n_, crossing_b + m_, n_, m_, deepest, apart)) {}

  std::optional<TubeTable> run() {
    std::optional<TubeTable> best;
    for (const Centre& first : first_)
      for (const Centre& last : last_) {
        if (first.is_triangle() && last.is_triangle()) continue;
        auto table = between(first, last);
        if (table && (!best || table->cost < best->cost)) best = std::move(table);
      }
    return best;
  }

 private:
  std::optional<TubeTable> between(const Centre& first, const Centre& last) {
    const int edges_a = n_ - first.half_a - last.half_a, edges_b = m_ - first.half_b - last.half_b;
    if (edges_a < 0 || edges_b < 0) return std::nullopt;
    SF_EXPECT(edges_a % 2 == 0 && edges_b % 2 == 0);
    const int begin_a = (crossing_a_ + first.half_a) / 2, begin_b = (crossing_b_ + first.half_b) / 2;
    paths_.solve({begin_a, begin_b, edges_a / 2, edges_b / 2, 0, apart_ - first.apart});
    const auto path = paths_.cheapest(last.apart);
    if (!path) return std::nullopt;
    const double begin = first.op ? paths_.skew(0, 0) + half_cost(first, -first.half_a, -first.half_b) : 0;
    const double end = half_cost(last, edges_a / 2, edges_b / 2);
    return unfolded(first, *path, last, 2 * (begin + path->cost + end));
  }

  // Of a column that is its own image and begins there.
  double half_cost(const Centre& centre, int i, int j) const {
    if (!centre.op) return 0;
    switch (centre.op->kind) {
      case TubeOpKind::StackA:
        return 0.5 * paths_.stack_a(i, j, centre.op->depth);
      case TubeOpKind::StackB:
        return 0.5 * paths_.stack_b(i, j, centre.op->depth);
      case TubeOpKind::Match:
        return 0;
      default:
        return 0.5 * options_.triangle_cost;
    }
  }

  TubeTable unfolded(const Centre& first, const TubePath& path, const Centre& last, double cost) const {
    TubeTable table;
    table.first = static_cast<std::size_t>(around((crossing_a_ - first.half_a) / 2, n_));
    table.start = static_cast<std::size_t>(around((crossing_b_ - first.half_b) / 2, m_));
    table.cost = cost;
    if (first.op) table.ops.push_back(*first.op);
    table.ops.insert(table.ops.end(), path.ops.begin(), path.ops.end());
    if (last.op) table.ops.push_back(*last.op);
    for (auto op = path.ops.rbegin(); op != path.ops.rend(); ++op) {
      TubeOp image = *op;
      if (image.kind == TubeOpKind::StackA) image.middle = around(crossing_a_ - image.middle, n_);
      if (image.kind == TubeOpKind::StackB) image.middle = around(crossing_b_ - image.middle, m_);
      table.ops.push_back(image);
    }
    table.mirror_sum = first.op ? table.ops.size() : table.ops.size() - 1;
    return table;
  }

  TubeSide a_, b_;
  int crossing_a_, crossing_b_, n_, m_;
  TubeOptions options_;
  int apart_;
  TubePaths paths_;
  std::vector<Centre> first_, last_;
};

}  // namespace

std::optional<LoopReflection> loop_reflection(std::span<const std::int32_t> loop,
                                              std::span<const std::int32_t> images) {
  const int n = static_cast<int>(loop.size());
  const auto first = std::find(loop.begin(), loop.end(), images[0]);
  const LoopReflection reflection{static_cast<int>(first - loop.begin())};
  for (int i = 0; i < n; ++i)
    if (images[static_cast<std::size_t>(i)] != loop[static_cast<std::size_t>(around(reflection.sum - i, n))])
      return std::nullopt;
  return reflection;
}

std::optional<TubeTable> solve_symmetric_tube(const TubeSide& a, LoopReflection on_a, const TubeSide& b,
                                              LoopReflection on_b, int rows, const TubeOptions& options) {
  const int m = static_cast<int>(b.theta.size());
  const int deepest = std::min(options.deepest, rows - 2);
  const auto apart_from_a = [&](int half) {  // in theta, round and round
    const double turns = theta_at_half(b, half) - theta_at_half(a, on_a.sum);
    return std::abs(turns - std::round(turns));
  };
  const int on_other_side = on_b.sum + m;
  const int crossing_b = apart_from_a(on_other_side) < apart_from_a(on_b.sum) ? on_other_side : on_b.sum;
  for (int apart = kMostApart; apart >= 0; --apart)
    if (auto table = HalfSolver(a, on_a.sum, b, crossing_b, deepest, options, apart).run()) return table;
  return std::nullopt;
}

}  // namespace skinforge
