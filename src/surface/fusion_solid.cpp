#include "surface/fusion_solid.h"

#include <algorithm>

#include "geometry/edges.h"

namespace skinforge {
namespace {

constexpr double kAddedPresence =
    0.1;  // ours: less is the body that the part was cut from; at 0.25 feather roots were lost

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

SiteParticipant cut_participant(SourceId source, const SourceSelection& selection,
                                std::span<const std::size_t> sites) {
  SiteParticipant participant{source, false, false, std::vector<double>(selection.presence.size(), 1), {}};
  bool is_cut = false;
  for (std::size_t c = 0; c < selection.cut_sites.size(); ++c) {
    if (std::find(sites.begin(), sites.end(), selection.cut_sites[c]) == sites.end()) continue;
    is_cut = true;
    for (std::size_t v = 0; v < participant.presence.size(); ++v)
      participant.presence[v] = std::min(participant.presence[v], selection.site_presence[c][v]);
  }
  for (const ComponentRole role : selection.face_role)
    participant.fusing.push_back(is_cut && role == ComponentRole::Blended ? 1 : 0);
  return participant;
}

void fuse_component_near(SiteParticipant& host, const PolygonMesh& mesh, const SourceSelection& selection,
                         const Vec3& where) {
  const Triangulation triangulation = triangulate(mesh);
  std::vector<Triangle> triangles;
  std::vector<FaceId> face;
  for (std::size_t t = 0; t < triangulation.triangles.size(); ++t) {
    if (selection.face_role[triangulation.face[t].index()] == ComponentRole::DroppedWhole) continue;
    const auto& corners = triangulation.triangles[t];
    triangles.push_back({corners[0].value, corners[1].value, corners[2].value});
    face.push_back(triangulation.face[t]);
  }
  const ClosestPoint nearest = TriangleBvh(mesh.positions, triangles).closest(where);
  if (nearest.triangle < 0) return;
  const Components components = connected_components(mesh);
  const std::int32_t chosen = components.of_face[face[nearest.triangle].index()];
  for (std::size_t f = 0; f < mesh.face_count(); ++f)
    if (components.of_face[f] == chosen) host.fusing[f] = 1;
}

FusionSolid fusion_solid(const PolygonMesh& mesh, const SiteParticipant& participant) {
  FusionSolid solid;
  solid.is_host = participant.is_host;
  solid.is_added = participant.is_added;
  std::vector<std::int32_t> renamed(mesh.vertex_count(), -1);
  const Triangulation all = triangulate(mesh);
  for (std::size_t t = 0; t < all.triangles.size(); ++t) {
    if (!participant.fusing[all.face[t].index()]) continue;
    const auto& corners = all.triangles[t];
    const bool is_present = std::all_of(corners.begin(), corners.end(), [&](VertexId v) {
      return participant.presence[v.index()] >= kAddedPresence;
    });
    if (participant.is_added && !is_present) continue;
    Triangle triangle{};
    for (int k = 0; k < 3; ++k) {
      std::int32_t& name = renamed[corners[k].index()];
      if (name < 0) {
        name = static_cast<std::int32_t>(solid.positions.size());
        solid.positions.push_back(mesh.positions[corners[k].index()]);
        solid.presence.push_back(participant.presence[corners[k].index()]);
      }
      triangle[k] = name;
    }
    solid.triangles.push_back(triangle);
  }
  if (participant.is_added) cap_openings(solid);
  solid.bvh = TriangleBvh(solid.positions, solid.triangles);
  return solid;
}

}  // namespace skinforge
