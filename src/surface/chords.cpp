#include "surface/chords.h"

#include <algorithm>
#include <map>

namespace skinforge {
namespace {

using EdgeKey = std::pair<std::int32_t, std::int32_t>;

// Triangles at each edge between two fixed vertices.
std::map<EdgeKey, int> fixed_edges(const TrianglePatch& patch) {
  std::map<EdgeKey, int> count;
  const auto fixed = static_cast<std::int32_t>(patch.fixed);
  for (const Triangle& t : patch.triangles)
    for (int k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(t[k], t[(k + 1) % 3]);
      if (high < fixed) ++count[{low, high}];
    }
  return count;
}

// Puts `middle` on the edge in each triangle that has it.
void split_edge(TrianglePatch& patch, const EdgeKey& edge, std::int32_t middle) {
  const std::size_t count = patch.triangles.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Triangle t = patch.triangles[i];
    for (int k = 0; k < 3; ++k) {
      const std::int32_t a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3];
      if (EdgeKey(std::minmax(a, b)) != edge) continue;
      patch.triangles[i] = {a, middle, c};
      patch.triangles.push_back({middle, b, c});
      break;
    }
  }
}

}  // namespace

TrianglePatch split_chords(TrianglePatch patch) {
  for (const auto& [edge, triangles] : fixed_edges(patch)) {
    if (triangles < 2) continue;
    const auto middle = static_cast<std::int32_t>(patch.positions.size());
    patch.positions.push_back(0.5 * (patch.positions[edge.first] + patch.positions[edge.second]));
    split_edge(patch, edge, middle);
  }
  return patch;
}

}  // namespace skinforge
