#include "io/written_weights.h"

#include <algorithm>

namespace skinforge {

std::vector<Influence> written_row(std::span<const Influence> row, std::size_t limit) {
  std::vector<Influence> cut = normalised_row({row.begin(), row.end()}, limit);
  const auto as_float = [](double weight) { return static_cast<double>(static_cast<float>(weight)); };
  double others = 0;
  for (std::size_t k = 1; k < cut.size(); ++k) {
    cut[k].weight = as_float(cut[k].weight);
    others += cut[k].weight;
  }
  if (!cut.empty()) cut.front().weight = as_float(1 - others);
  std::erase_if(cut, [](const Influence& i) { return i.weight == 0; });
  return cut;
}

SkinWeights written_weights(const SkinWeights& weights, std::size_t limit) {
  SkinWeights written;
  for (std::size_t v = 0; v < weights.vertex_count(); ++v)
    written.push_row(written_row(weights.of(VertexId(v)), limit));
  return written;
}

}  // namespace skinforge
