#include "surface/tube_table.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/expect.h"
#include "surface/tube_path.h"

namespace skinforge {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr int kMostApart = 2;  // matches between two stacks

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
  const int n = static_cast<int>(a.theta.size()), m = static_cast<int>(b.theta.size());
  const int middle = nearest_start(a, b);
  for (int apart = kMostApart; apart >= 0; --apart) {
    TubePaths paths(a, b, deepest, options, apart);
    std::optional<TubeTable> best;
    for (int start = middle - options.start_reach; start <= middle + options.start_reach; ++start) {
      paths.solve({0, start, n, m, (n + m) % 2, apart});
      auto path = paths.cheapest(0);
      if (!path || (best && path->cost >= best->cost)) continue;
      best =
          TubeTable{0, static_cast<std::size_t>(((start % m) + m) % m), std::move(path->ops), path->cost, {}};
    }
    if (best) return best;
  }
  return std::nullopt;
}

}  // namespace skinforge
