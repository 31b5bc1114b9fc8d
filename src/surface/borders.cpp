#include "surface/borders.h"

namespace skinforge {

Borders lay_borders(const std::vector<JunctionLoop>& loops) {
  Borders borders;
  for (const JunctionLoop& loop : loops) {
    IndexLoop indices;
    for (const Vec3& p : loop.positions) {
      indices.push_back(static_cast<std::int32_t>(borders.patch.positions.size()));
      borders.patch.positions.push_back(p);
    }
    borders.loops.push_back(std::move(indices));
  }
  borders.patch.fixed = borders.patch.positions.size();
  return borders;
}

std::vector<Vec3> positions_of(const TrianglePatch& patch, const IndexLoop& loop) {
  std::vector<Vec3> positions;
  for (const std::int32_t v : loop) positions.push_back(patch.positions[v]);
  return positions;
}

void add_zip(TrianglePatch& patch, const IndexLoop& border, const IndexLoop& ring,
             const OutwardDirection& outward) {
  for (const Triangle& t : zip_rings(positions_of(patch, border), positions_of(patch, ring), outward)) {
    const auto vertex = [&](std::int32_t i) {
      const auto n = static_cast<std::int32_t>(border.size());
      return i < n ? border[i] : ring[i - n];
    };
    patch.triangles.push_back({vertex(t[0]), vertex(t[1]), vertex(t[2])});
  }
}

void add_fill(TrianglePatch& patch, const IndexLoop& loop) {
  for (const Triangle& t : fill_loop(positions_of(patch, loop)))
    patch.triangles.push_back({loop[t[0]], loop[t[1]], loop[t[2]]});
}

}  // namespace skinforge
