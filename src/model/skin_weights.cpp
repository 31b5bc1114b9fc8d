#include "model/skin_weights.h"

#include <algorithm>
#include <cmath>

namespace skinforge {

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
  std::stable_sort(merged.begin(), merged.end(),
                   [](const Influence& a, const Influence& b) { return a.weight > b.weight; });
  if (limit > 0 && merged.size() > limit) merged.resize(limit);
  double sum = 0;
  for (const Influence& influence : merged) sum += influence.weight;
  for (Influence& influence : merged) influence.weight /= sum;
  return merged;
}

}  // namespace skinforge
