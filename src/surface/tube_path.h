#pragma once

#include <optional>
#include <vector>

#include "surface/tube_table.h"

namespace skinforge {

/// Where the columns of a path begin and how many edges of both sides they use.
struct TubeStretch {
  int first_a = 0, first_b = 0;  ///< vertices; any whole number, sides go round
  int edges_a = 0, edges_b = 0;
  int triangles = 0;  ///< at most one
  int since = 0;      ///< matches since the last stack before the beginning, at most `apart`
};

/// A row of columns beside each other.
struct TubePath {
  std::vector<TubeOp> ops;
  double cost = 0;
};

/// The cheapest columns between two borders by dynamic programming over (edges of A, edges of B, triangles,
/// matches since the last stack), with the costs of `solve_tube`.
class TubePaths {
 public:
  /// `apart`: matches between two stacks. Refers to its arguments.
  TubePaths(const TubeSide& a, const TubeSide& b, int deepest, const TubeOptions& options, int apart);

  /// Works out all ways from where a stretch begins.
  void solve(const TubeStretch& stretch);

  /// The cheapest way to its end with that many matches or more after the last stack; none when there is
  /// none. The cost holds that of its end but not of its beginning.
  std::optional<TubePath> cheapest(int since) const;

  /// Cost of the column end between two vertices, and of a stack that begins there.
  double skew(int i, int j) const;
  double stack_a(int i, int j, int depth) const;
  double stack_b(int i, int j, int depth) const;

 private:
  struct State {
    double cost;
    TubeOp op;
    int since_before = 0;
  };
  std::size_t name(int i, int j, int t, int since) const;
  void go_on(int i, int j, int t, int since);
  void offer(int i, int j, int t, int since, double cost, TubeOp op, int since_before);

  const TubeSide& a_;
  const TubeSide& b_;
  int n_, m_, deepest_;
  const TubeOptions& options_;
  int apart_;
  double spacing_;
  TubeStretch stretch_;
  std::vector<State> states_;
};

}  // namespace skinforge
