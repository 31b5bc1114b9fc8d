#include "surface/tube_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/expect.h"

namespace skinforge {
namespace {

constexpr double kNotch = 0.75 * std::numbers::pi;  // ours: 135 degrees; a border that turns in more sharply

// A column: where it stands on both sides, and where it loses its edges.
struct Column {
  TubeOp op;
  int a = 0, b = 0;          // its first vertex on A, and on B as counted from the start
  int from_a = 0, to_b = 0;  // its edges on A and on B
  int first_row = 0;         // of a stack or triangle, counted from the side that loses edges
};

class Builder {
 public:
  Builder(const TubeTable& table, const TubeSide& a, const TubeSide& b, std::span<const double> height)
      : table_(table), a_(a), b_(b), height_(height), rows_(static_cast<int>(height.size()) - 1) {}

  TubeMesh run() {
    lay_columns();
    place_stacks();
    number_vertices();
    for (int r = 0; r < rows_; ++r) add_row(r);
    place_vertices();
    return std::move(mesh_);
  }

 private:
  int n() const { return static_cast<int>(a_.theta.size()); }
  int m() const { return static_cast<int>(b_.theta.size()); }

  void lay_columns() {
    int a = 0, b = 0;
    for (const TubeOp& op : table_.ops) {
      Column column{op, a, b, 0, 0, 0};
      if (op.kind == TubeOpKind::Match) column.from_a = column.to_b = 1;
      if (op.kind == TubeOpKind::StackA) column.from_a = 2 * op.depth;
      if (op.kind == TubeOpKind::StackB) column.to_b = 2 * op.depth;
      if (op.kind == TubeOpKind::TriangleA) column.from_a = 1;
      if (op.kind == TubeOpKind::TriangleB) column.to_b = 1;
      a += column.from_a;
      b += column.to_b;
      columns_.push_back(column);
    }
    SF_EXPECT(a == n() && b == m());
  }

  // Neighbouring stacks lose their edges in rows far from each other: steps of the golden ratio. Images lose
  // theirs in the same row.
  void place_stacks() {
    constexpr double kGolden = 0.6180339887498949;
    double turn = 0;
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      Column& column = columns_[k];
      if (column.op.kind == TubeOpKind::Match) continue;
      if (table_.mirror_sum && *table_.mirror_sum - k < k) {
        column.first_row = columns_[*table_.mirror_sum - k].first_row;
        continue;
      }
      const bool on_a = column.from_a > 0;
      const TubeSide& side = on_a ? a_ : b_;
      const int choices = std::max(1, rows_ - 1 - column.op.depth);
      turn = std::fmod(turn + kGolden, 1.0);
      column.first_row = std::min(1 + static_cast<int>(turn * choices), rows_ - column.op.depth);
      const bool is_notch = side.angle[static_cast<std::size_t>(column.op.middle)] < kNotch;
      if (is_notch) column.first_row = 0;
    }
  }

  // Edges of a column that are left at a row.
  int live(const Column& column, int row) const {
    if (column.op.kind == TubeOpKind::Match) return 1;
    const bool on_a = column.from_a > 0;
    const int steps = std::clamp((on_a ? row : rows_ - row) - column.first_row, 0, column.op.depth);
    const int each = column.op.kind == TubeOpKind::StackA || column.op.kind == TubeOpKind::StackB ? 2 : 1;
    return each * (column.op.depth - steps);
  }

  void number_vertices() {
    first_.assign(static_cast<std::size_t>(rows_) + 1, 0);
    count_.assign(static_cast<std::size_t>(rows_) + 1, 0);
    std::int32_t next = n() + m();
    for (int r = 0; r <= rows_; ++r) {
      int edges = 0;
      for (const Column& column : columns_) edges += live(column, r);
      count_[r] = edges;
      if (r == 0 || r == rows_) continue;
      first_[r] = next;
      next += edges;
    }
    mesh_.row.assign(static_cast<std::size_t>(next), 0);
    mesh_.theta.assign(static_cast<std::size_t>(next), 0);
  }

  std::int32_t vertex(int row, int k) const {
    const int inside = k % count_[row];
    if (row == 0)
      return static_cast<std::int32_t>((table_.first + static_cast<std::size_t>(inside)) % a_.theta.size());
    if (row == rows_)
      return n() +
             static_cast<std::int32_t>((table_.start + static_cast<std::size_t>(inside)) % b_.theta.size());
    return first_[row] + inside;
  }

  void add_row(int r) {
    int below = 0, above = 0;
    for (const Column& column : columns_) {
      const int p = live(column, r), q = live(column, r + 1);
      add_cells(r, below, above, p, q);
      below += p;
      above += q;
    }
  }

  // Faces of one column between two rows: quads, and where two edges end a diamond between them.
  void add_cells(int r, int below, int above, int p, int q) {
    const auto low = [&](int k) { return vertex(r, below + k); };
    const auto high = [&](int k) { return vertex(r + 1, above + k); };
    const auto quad = [&](int k, int l) {
      mesh_.quads.push_back({low(k), low(k + 1), high(l + 1), high(l)});
    };
    const int half = std::max(p, q) / 2;
    if (p == q) {
      for (int k = 0; k < p; ++k) quad(k, k);
    } else if (p + q == 1) {
      mesh_.triangles.push_back(p == 1 ? Triangle{low(0), low(1), high(0)}
                                       : Triangle{low(0), high(1), high(0)});
    } else {
      for (int k = 0; k + 1 < half; ++k) quad(k, k);
      if (p > q)
        mesh_.quads.push_back({low(half - 1), low(half), low(half + 1), high(half - 1)});
      else
        mesh_.quads.push_back({low(half - 1), high(half + 1), high(half), high(half - 1)});
      for (int k = half; k + 1 < std::max(p, q); ++k) quad(p > q ? k + 1 : k - 1, p > q ? k - 1 : k + 1);
    }
  }

  double theta_a(int i) const {
    const int k = static_cast<int>(table_.first) + i;
    return a_.theta[static_cast<std::size_t>(k % n())] + k / n();
  }
  double theta_b(int j) const {
    const int k = static_cast<int>(table_.start) + j;
    return b_.theta[static_cast<std::size_t>(k % m())] + k / m() + turns_;
  }

  // Theta of a vertex: the mean over the columns that it belongs to.
  void place_vertices() {
    turns_ = std::round(theta_a(0) - theta_b(0));
    std::vector<double> sum(mesh_.theta.size(), 0);
    std::vector<int> uses(mesh_.theta.size(), 0);
    for (int r = 0; r <= rows_; ++r) {
      int k = 0;
      for (const Column& column : columns_) {
        const int edges = live(column, r);
        const auto at = [&](int i, int j) { return theta_a(i) + height_[r] * (theta_b(j) - theta_a(i)); };
        const double left = at(column.a, column.b),
                     right = at(column.a + column.from_a, column.b + column.to_b);
        for (int e = 0; e <= edges; ++e) {
          const double share = edges == 0 ? 0.5 : static_cast<double>(e) / edges;
          const auto v = static_cast<std::size_t>(vertex(r, k + e));
          const double turn = k + e == count_[r] ? 1 : 0;  // the last vertex is the first, a turn later
          sum[v] += left + share * (right - left) - turn;
          ++uses[v];
          mesh_.row[v] = r;
        }
        k += edges;
      }
    }
    for (std::size_t v = 0; v < sum.size(); ++v) mesh_.theta[v] = sum[v] / std::max(uses[v], 1);
  }

  const TubeTable& table_;
  const TubeSide& a_;
  const TubeSide& b_;
  std::span<const double> height_;
  int rows_;
  double turns_ = 0;
  std::vector<Column> columns_;
  std::vector<std::int32_t> first_;  // per row: its first vertex
  std::vector<int> count_;           // per row: its vertices
  TubeMesh mesh_;
};

}  // namespace

TubeMesh mesh_of(const TubeTable& table, const TubeSide& a, const TubeSide& b,
                 std::span<const double> height) {
  SF_EXPECT(height.size() >= 3);
  return Builder(table, a, b, height).run();
}

}  // namespace skinforge
