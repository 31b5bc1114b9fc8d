#include "report/distribution.h"

#include <algorithm>
#include <numeric>

namespace skinforge {
namespace {

double percentile(const std::vector<double>& sorted, double percent) {
  const double rank = percent / 100 * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(rank);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (rank - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

}  // namespace

std::optional<Distribution> distribution_of(std::vector<double> values) {
  if (values.empty()) return std::nullopt;
  std::sort(values.begin(), values.end());
  Distribution d;
  d.count = static_cast<std::int64_t>(values.size());
  d.min = values.front();
  d.mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  d.p05 = percentile(values, 5);
  d.p25 = percentile(values, 25);
  d.p50 = percentile(values, 50);
  d.p75 = percentile(values, 75);
  d.p95 = percentile(values, 95);
  d.max = values.back();
  return d;
}

}  // namespace skinforge
