#include "model/skin_weights.h"

#include <algorithm>
#include <cmath>

namespace skinforge {
namespace {

// On a plane of symmetry left and right weigh the same: roundings must not choose between them.
void keep_largest(std::vector<Influence>& row, std::size_t limit) {
  constexpr double kStep = 1.0 / 4096;  // ours: of the row's sum; less does not show
  double sum = 0;
  for (const Influence& influence : row) sum += influence.weight;
  const auto steps = [sum](const Influence& i) { return std::llround(i.weight / sum / kStep); };
  std::stable_sort(row.begin(), row.end(),
                   [&](const Influence& a, const Influence& b) { return steps(a) > steps(b); });
  row.resize(limit);
}

}  // namespace

std::vector<Influence> normalised_row(std::vector<Influence> row, std::size_t limit) {
  std::erase_if(row, [](const Influence& i) { return !(i.weight > 0) || !std::isfinite(i.weight); });
  std::sort(row.begin(), row.end(), [](const Influence& a, const Influence& b) { return a.joint < b.joint; });
  std::vector<Influence> merged;
  for (const Influence& influence : row) {
    if (!merged.empty() && merged.back().joint == influence.joint)
      merged.back().weight += influence.weight;
    else
      merged.push_back(influence);
  }
  if (limit > 0 && merged.size() > limit) keep_largest(merged, limit);
  std::stable_sort(merged.begin(), merged.end(),
                   [](const Influence& a, const Influence& b) { return a.weight > b.weight; });
  double sum = 0;
  for (const Influence& influence : merged) sum += influence.weight;
  for (Influence& influence : merged) influence.weight /= sum;
  return merged;
}

}  // namespace skinforge
