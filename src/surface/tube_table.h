#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace skinforge {

/// One border of a tube, once around in the direction in which theta rises.
struct TubeSide {
  std::vector<double> theta;  ///< #vertices, in turns, rising; spans less than one turn
  std::vector<double> angle;  ///< #vertices, radians on the tube's side of the border; pi is straight
};

/// How a column of the tube begins on side A and ends on side B (junction.md b.2, step 3).
enum class TubeOpKind : std::uint8_t {
  Match,      ///< one edge of A goes on to one edge of B
  StackA,     ///< 2 * depth edges of A end in `depth` diamonds above each other
  StackB,     ///< the same for edges of B
  TriangleA,  ///< one edge of A ends in a triangle
  TriangleB,
};

struct TubeOp {
  TubeOpKind kind = TubeOpKind::Match;
  int depth = 0;   ///< diamonds of a stack; 1 for a triangle
  int middle = 0;  ///< border vertex in the middle of a stack, of its own side

  bool operator==(const TubeOp&) const = default;
};

/// Columns of a tube, once around. They begin at vertex `first` of A and at vertex `start` of B.
struct TubeTable {
  std::size_t first = 0, start = 0;
  std::vector<TubeOp> ops;
  double cost = 0;
  std::optional<std::size_t> mirror_sum;  ///< in a mirrored table columns k and `mirror_sum` - k are images

  bool operator==(const TubeTable& other) const {
    return first == other.first && start == other.start && ops == other.ops;
  }
};

struct TubeOptions {
  double stack_cost = 10;    ///< lambda of junction.md b.2: few deep stacks rather than many diamonds
  double triangle_cost = 4;  ///< lambda_t
  double corner_cost = 4;    ///< mu; ours: stacks go where the border turns in
  double notch_cost = 60;    ///< ours: no column ends where the border turns in sharply
  int deepest = 4;           ///< diamonds above each other; also at most `rows` - 2
  int start_reach = 3;       ///< vertices of B to either side of where A begins
};

/// The cheapest columns that use every edge of both sides once, by dynamic programming over (edges of A,
/// edges of B, triangles, matches since the last stack), for every start in reach. Cost: squared differences
/// of theta at the ends of columns, in mean spacings, plus that of each stack, triangle and sharp notch.
/// Stacks keep two matches apart, fewer where that is not possible. Without triangles when #a + #b is even,
/// with one when odd. None when the counts differ by more than the rows can take. O(starts * #a * #b *
/// deepest).
std::optional<TubeTable> solve_tube(const TubeSide& a, const TubeSide& b, int rows,
                                    const TubeOptions& options = {});

}  // namespace skinforge
