#include "stages/placed_sources.h"

#include <optional>

#include "stages/surface_options.h"

namespace skinforge {
namespace {

std::vector<Vec3> shift_of(const PlacedOperations& placement, const Graft& graft, SourceId source) {
  for (std::size_t k = 0; k < graft.sites.size(); ++k)
    if (graft.sites[k].donor == source) return placement.joint_shifts[k];
  return {};
}

// A donor has lost everything outside its sub-tree from the start; the parent stays with it where asked. All
// is lost where a later operation took the top of the sub-tree.
Cut cut_of_donor(const Graft& graft, const GraftSite& site, const Skeleton& skeleton,
                 const CutOptions& options) {
  if (!site.fused.is_valid()) return {0, std::vector<bool>(skeleton.size(), true), options.from};
  const JointId top = graft.origins[site.fused.index()].joint;
  Cut cut{0, skeleton.subtree(top), options.from};
  if (const JointId parent = skeleton[top].parent; options.include_parent.from && parent.is_valid())
    cut.removed[parent.index()] = true;
  cut.removed.flip();
  for (const auto& [owner, joint] : site.removed)
    if (owner == site.donor) cut.removed[joint.index()] = true;
  return cut;
}

// The joints that an operation takes from a source that was there before; with the parents where asked, whose
// skin goes although the joints stay.
std::optional<Cut> cut_of_host(const GraftSite& site, SourceId source, const Skeleton& skeleton,
                               const CutOptions& options) {
  Cut cut{0, std::vector<bool>(skeleton.size(), false), options.at};
  bool any = false;
  const auto take = [&](const std::vector<std::pair<SourceId, JointId>>& joints) {
    for (const auto& [owner, joint] : joints)
      if (owner == source) cut.removed[joint.index()] = any = true;
  };
  take(site.removed);
  if (options.include_parent.at) take(site.parents);
  return any ? std::optional(cut) : std::nullopt;
}

}  // namespace

CutOptions cut_options(const SurfaceOptions& surface) {
  return {selection_options(surface, false), selection_options(surface, true), surface.include_parent};
}

PolygonMesh place_mesh(const Character& character, const Graft& graft, SourceId source,
                       const PlacedOperations& placement) {
  const Similarity& model_from_input = graft.sources[source.index()].model_from_input;
  const std::vector<Vec3> joint_shift = shift_of(placement, graft, source);
  PolygonMesh mesh = character.mesh;
  if (!model_from_input.is_identity()) {
    for (Vec3& p : mesh.positions) p = model_from_input * p;
    for (Vec3& n : mesh.normals) n = model_from_input.rotation * n;
    for (SplitNormals& split : mesh.split)
      for (auto* normals : {&split.first, &split.second})
        for (Vec3& n : *normals) n = model_from_input.rotation * n;
  }
  if (joint_shift.empty()) return mesh;
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v)
    for (const Influence& i : character.weights.of(VertexId(v)))
      mesh.positions[v] += i.weight * joint_shift[i.joint.index()];
  return mesh;
}

std::vector<Cut> cuts_of_source(const Graft& graft, const Skeleton& skeleton, SourceId source,
                                std::span<const CutOptions> options) {
  std::vector<Cut> cuts;
  for (std::size_t k = 0; k < graft.sites.size(); ++k) {
    const GraftSite& site = graft.sites[k];
    std::optional<Cut> cut;
    if (site.donor == source)
      cut = cut_of_donor(graft, site, skeleton, options[k]);
    else
      cut = cut_of_host(site, source, skeleton, options[k]);
    if (!cut) continue;
    cut->site = k;
    cut->is_of_added = site.donor == source && site.kind == GraftKind::Attach;
    cuts.push_back(std::move(*cut));
  }
  return cuts;
}

}  // namespace skinforge
