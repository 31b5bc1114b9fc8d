#include "stages/placed_surfaces.h"

namespace skinforge {

PlacedSurfaces::PlacedSurfaces(const std::vector<PolygonMesh>& placed) : placed_(&placed) {
  for (const PolygonMesh& mesh : placed) {
    triangulations_.push_back(triangulate(mesh));
    std::vector<std::array<std::int32_t, 3>> triangles;
    for (const auto& t : triangulations_.back().triangles)
      triangles.push_back({t[0].value, t[1].value, t[2].value});
    bvhs_.emplace_back(mesh.positions, triangles);
  }
}

}  // namespace skinforge
