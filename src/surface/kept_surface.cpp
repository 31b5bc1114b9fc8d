#include "surface/kept_surface.h"

namespace skinforge {

KeptSurface kept_surface(std::span<const PreservedSource> sources) {
  KeptSurface kept;
  for (std::size_t s = 0; s < sources.size(); ++s) {
    const PreservedSource& source = sources[s];
    const auto first = static_cast<std::int32_t>(kept.positions.size());
    kept.first.push_back(first);
    kept.positions.insert(kept.positions.end(), source.mesh->positions.begin(), source.mesh->positions.end());
    const Triangulation all = triangulate(*source.mesh);
    for (std::size_t t = 0; t < all.triangles.size(); ++t) {
      if (!source.selection.kept[all.face[t].index()]) continue;
      const auto& c = all.triangles[t];
      kept.triangles.push_back({c[0].value + first, c[1].value + first, c[2].value + first});
      kept.origin.emplace_back(SourceId(s), all.face[t]);
    }
  }
  kept.bvh = TriangleBvh(kept.positions, kept.triangles);
  return kept;
}

}  // namespace skinforge
