#include "surface/fusion_solid.h"

#include <algorithm>

namespace skinforge {
namespace {

// Closes every opening of the solid by a fan about the centre of its loop.
void cap_openings(FusionSolid& solid) {
  for (const auto& loop : boundary_loops(solid.triangles)) {
    Vec3 centre = Vec3::Zero();
    double presence = 0;
    for (const std::int32_t v : loop) {
      centre += solid.positions[v] / static_cast<double>(loop.size());
      presence += solid.presence[v] / static_cast<double>(loop.size());
    }
    const auto apex = static_cast<std::int32_t>(solid.positions.size());
    solid.positions.push_back(centre);
    solid.presence.push_back(presence);
    for (std::size_t i = 0; i < loop.size(); ++i)
      solid.triangles.push_back({loop[(i + 1) % loop.size()], loop[i], apex});
  }
}

}  // namespace

FusionSolid fusion_solid(const PolygonMesh& mesh, const SourceSelection& selection,
                         const std::vector<double>& presence, bool is_host, SolidExtent extent) {
  FusionSolid solid;
  solid.is_host = is_host;
  std::vector<std::int32_t> renamed(mesh.vertex_count(), -1);
  const Triangulation all = triangulate(mesh);
  for (std::size_t t = 0; t < all.triangles.size(); ++t) {
    if (selection.face_role[all.face[t].index()] != ComponentRole::Blended && !selection.cut_sites.empty())
      continue;
    const auto& corners = all.triangles[t];
    const bool is_present =
        std::any_of(corners.begin(), corners.end(), [&](VertexId v) { return presence[v.index()] > 0; });
    if (extent == SolidExtent::Trimmed && !is_present) continue;
    Triangle triangle{};
    for (int k = 0; k < 3; ++k) {
      std::int32_t& name = renamed[corners[k].index()];
      if (name < 0) {
        name = static_cast<std::int32_t>(solid.positions.size());
        solid.positions.push_back(mesh.positions[corners[k].index()]);
        solid.presence.push_back(presence[corners[k].index()]);
      }
      triangle[k] = name;
    }
    solid.triangles.push_back(triangle);
  }
  if (extent == SolidExtent::Trimmed) cap_openings(solid);
  solid.bvh = TriangleBvh(solid.positions, solid.triangles);
  return solid;
}

}  // namespace skinforge
