#include "surface/ring_zip.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/expect.h"

namespace skinforge {
namespace {

constexpr double kLongEdge = 0.05;     // design: cost = area + 0.05 diagonal^2
constexpr double kInward = 4.0;        // ours: a triangle facing inwards costs up to nine times its area
constexpr double kSameCost = 1e-5;     // ours: the same zip from another start, added up in another order
constexpr std::size_t kMaxFill = 256;  // ours: 256^3 / 6 steps are 30 ms

// `outward`: away from the solid, of any length; zero where that is not known.
double triangle_cost(const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& outward) {
  const Vec3 cross = (q - p).cross(r - p);
  const double area = 0.5 * cross.norm();
  const double longest = std::max({(q - p).squaredNorm(), (r - q).squaredNorm(), (p - r).squaredNorm()});
  const double length = outward.norm();
  const double facing = area > 0 && length > 0 ? cross.dot(outward) / (2 * area * length) : 1;
  return area * (1 + kInward * (1 - facing)) + kLongEdge * longest;
}

// A loop and the direction away from the solid at each of its vertices.
struct Ring {
  std::span<const Vec3> positions;
  std::vector<Vec3> outward;

  Ring(std::span<const Vec3> loop, const OutwardDirection& direction) : positions(loop) {
    for (const Vec3& p : loop) outward.push_back(direction ? direction(p).normalized() : Vec3(Vec3::Zero()));
  }
  std::size_t size() const { return positions.size(); }
};

struct Zip {
  double cost = std::numeric_limits<double>::infinity();
  std::vector<Triangle> triangles;
};

// What going on from the rung between a[i] and c[j] costs, #a x #c each: the same from every start.
struct StepCosts {
  std::vector<double> along_a, along_c;

  StepCosts(const Ring& a, const Ring& c) {
    const std::size_t n = a.size(), m = c.size();
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < m; ++j) {
        const std::size_t after_i = (i + 1) % n, after_j = (j + 1) % m;
        along_a.push_back(triangle_cost(a.positions[i], a.positions[after_i], c.positions[j],
                                        a.outward[i] + a.outward[after_i] + c.outward[j]));
        along_c.push_back(triangle_cost(a.positions[i], c.positions[after_j], c.positions[j],
                                        a.outward[i] + c.outward[after_j] + c.outward[j]));
      }
  }
};

// What is left to pay, at least, from the rung between a[i] and c[j] on: the cheapest way to the end of `a`,
// #a + 1 x #c, wherever along `c` it ends.
std::vector<double> least_left(std::size_t n, std::size_t m, const StepCosts& step) {
  std::vector<double> left((n + 1) * m, 0.0);
  for (std::size_t i = n; i-- > 0;) {
    double* row = left.data() + i * m;
    for (std::size_t j = 0; j < m; ++j) row[j] = step.along_a[i * m + j] + row[m + j];
    for (int round = 0; round < 2; ++round)  // the row is a ring
      for (std::size_t j = m; j-- > 0;)
        row[j] = std::min(row[j], step.along_c[i * m + j] + row[j + 1 < m ? j + 1 : 0]);
  }
  return left;
}

// Best zip whose first rung joins a[0] and c[start]; rungs (i, j) join a[i % n] and c[(start + j) % m].
// Nothing where it would cost more than `most`: rungs from which `left` leads beyond that are passed over.
Zip zip_from(std::size_t n, std::size_t m, const StepCosts& step, const std::vector<double>& left,
             std::size_t start, double most) {
  if (!(left[start] <= most)) return {};
  const std::size_t width = m + 1;
  std::vector<double> cost((n + 1) * width, std::numeric_limits<double>::infinity());
  std::vector<char> along_a(cost.size(), 0);
  cost[0] = 0;
  std::size_t first = 0, last = 0;  // in this row, of the rungs that are reached
  for (std::size_t i = 0; i <= n; ++i) {
    std::size_t next_first = width, next_last = 0;
    for (std::size_t j = first; j <= last; ++j) {
      const double here = cost[i * width + j];
      const std::size_t in_c = start + j < m ? start + j : (start + j - m) % m, rung = (i % n) * m + in_c;
      if (!(here + left[i * m + in_c] <= most)) continue;
      if (i < n) {
        const double next = here + step.along_a[rung];
        if (next < cost[(i + 1) * width + j])
          cost[(i + 1) * width + j] = next, along_a[(i + 1) * width + j] = 1;
        next_first = std::min(next_first, j);
        next_last = j;
      }
      if (j < m) {
        const double next = here + step.along_c[rung];
        if (next < cost[i * width + j + 1]) cost[i * width + j + 1] = next, along_a[i * width + j + 1] = 0;
        last = std::max(last, j + 1);
      }
    }
    if (i < n) first = next_first, last = next_last;
  }
  if (!(cost.back() <= most)) return {};
  Zip zip{cost.back(), {}};
  const auto in_a = [&](std::size_t i) { return static_cast<std::int32_t>(i % n); };
  const auto in_c = [&](std::size_t j) { return static_cast<std::int32_t>(n + (start + j) % m); };
  for (std::size_t i = n, j = m; i + j > 0;) {
    if (along_a[i * width + j]) {
      --i;
      zip.triangles.push_back({in_a(i), in_a(i + 1), in_c(j)});
    } else {
      --j;
      zip.triangles.push_back({in_a(i), in_c(j + 1), in_c(j)});
    }
  }
  std::reverse(zip.triangles.begin(), zip.triangles.end());
  return zip;
}

// Starts to try: the vertices of c nearest to a[0], one in four of them at least, never fewer than 3.
std::vector<std::size_t> candidate_starts(const Vec3& a0, std::span<const Vec3> c) {
  std::vector<std::size_t> order(c.size());
  for (std::size_t j = 0; j < c.size(); ++j) order[j] = j;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
    return (c[i] - a0).squaredNorm() < (c[j] - a0).squaredNorm();
  });
  order.resize(std::min(c.size(), std::max<std::size_t>(3, c.size() / 4)));
  return order;
}

}  // namespace

std::vector<Triangle> zip_rings(std::span<const Vec3> a, std::span<const Vec3> c,
                                const OutwardDirection& outward) {
  SF_EXPECT(a.size() >= 3 && c.size() >= 3);
  const StepCosts costs(Ring(a, outward), Ring(c, outward));
  const std::vector<double> left = least_left(a.size(), c.size(), costs);
  Zip best;
  std::size_t best_start = 0;
  for (const std::size_t start : candidate_starts(a[0], c)) {
    Zip zip = zip_from(a.size(), c.size(), costs, left, start, (1 + 2 * kSameCost) * best.cost);
    if (zip.triangles.empty()) continue;
    const bool is_equal = std::abs(zip.cost - best.cost) <= kSameCost * zip.cost;
    if (is_equal ? start < best_start : zip.cost < best.cost) best = std::move(zip), best_start = start;
  }
  return best.triangles;
}

std::vector<Triangle> fill_loop(std::span<const Vec3> loop) {
  SF_EXPECT(loop.size() >= 3);
  const std::size_t n = loop.size();
  std::vector<Triangle> triangles;
  if (n > kMaxFill) {
    for (std::size_t i = 1; i + 1 < n; ++i)
      triangles.push_back({0, static_cast<std::int32_t>(i), static_cast<std::int32_t>(i + 1)});
    return triangles;
  }
  std::vector<double> cost(n * n, 0);
  std::vector<std::size_t> apex(n * n, 0);
  for (std::size_t span = 2; span < n; ++span) {
    for (std::size_t i = 0; i + span < n; ++i) {
      const std::size_t k = i + span;
      double& best = cost[i * n + k];
      best = std::numeric_limits<double>::infinity();
      for (std::size_t j = i + 1; j < k; ++j) {
        const double total =
            cost[i * n + j] + cost[j * n + k] + triangle_cost(loop[i], loop[j], loop[k], Vec3::Zero());
        if (total < best) best = total, apex[i * n + k] = j;
      }
    }
  }
  std::vector<std::pair<std::size_t, std::size_t>> open{{0, n - 1}};
  while (!open.empty()) {
    const auto [i, k] = open.back();
    open.pop_back();
    if (k - i < 2) continue;
    const std::size_t j = apex[i * n + k];
    triangles.push_back(
        {static_cast<std::int32_t>(i), static_cast<std::int32_t>(j), static_cast<std::int32_t>(k)});
    open.push_back({i, j});
    open.push_back({j, k});
  }
  return triangles;
}

}  // namespace skinforge
