#include "stages/site_solids.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "surface/cut_line.h"

namespace skinforge {
namespace {

Vec3 donor_centre(const Graft& graft, const GraftSite& site, const PolygonMesh& donor_mesh,
                  const SiteParticipant& donor) {
  if (const auto cut = longest_cut_line(donor_mesh, donor.presence)) return cut->centre;
  return graft.skeleton[site.fused].joint_from_model.inverse().translation();
}

std::vector<SiteParticipant> participants_of(const Graft& graft, const SiteGroup& group,
                                             const std::vector<PolygonMesh>& placed,
                                             const std::vector<SourceSelection>& selections) {
  std::set<SourceId> hosts;
  for (const std::size_t k : group) {
    const GraftSite& site = graft.sites[k];
    if (site.kind == GraftKind::Attach) hosts.insert(site.host);
    for (const auto& [source, joint] : site.removed) hosts.insert(source);
  }
  std::vector<SiteParticipant> participants;
  for (const SourceId host : hosts) {
    participants.push_back(cut_participant(host, selections[host.index()], group));
    participants.back().is_host = true;
  }
  for (const std::size_t k : group) {
    const GraftSite& site = graft.sites[k];
    if (!site.donor.is_valid() || hosts.contains(site.donor)) continue;
    SiteParticipant donor = cut_participant(site.donor, selections[site.donor.index()], group);
    donor.is_added = site.kind == GraftKind::Attach;
    const Vec3 where = donor_centre(graft, site, placed[site.donor.index()], donor);
    for (SiteParticipant& host : participants)
      if (donor.is_added && host.source == site.host)
        fuse_component_near(host, placed[host.source.index()], selections[host.source.index()], where);
    participants.push_back(std::move(donor));
  }
  return participants;
}

std::set<SourceId> hosts_of(const GraftSite& site) {
  std::set<SourceId> hosts{site.host};
  for (const auto& [source, joint] : site.removed) hosts.insert(source);
  return hosts;
}

// Where one site may discard faces of its hosts: per host, its vertices in reach of the site's field, and all
// others of their faces.
std::map<SourceId, std::set<VertexId>> touched_vertices(const Graft& graft, std::size_t site,
                                                        const std::vector<PolygonMesh>& placed,
                                                        const std::vector<SourceSelection>& selections,
                                                        const FieldOptions& options) {
  const Lattice lattice = field_lattice(site_solids(graft, {site}, placed, selections).solids, options);
  std::map<SourceId, std::set<VertexId>> touched;
  if (lattice.count() == 0) return touched;
  const Eigen::AlignedBox3d box = lattice.box();
  for (const SourceId host : hosts_of(graft.sites[site])) {
    const PolygonMesh& mesh = placed[host.index()];
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
      const auto face = mesh.face(FaceId(f));
      const auto is_inside = [&](VertexId v) { return box.contains(mesh.positions[v.index()]); };
      if (std::any_of(face.begin(), face.end(), is_inside)) touched[host].insert(face.begin(), face.end());
    }
  }
  return touched;
}

bool meet(const std::map<SourceId, std::set<VertexId>>& a, const std::map<SourceId, std::set<VertexId>>& b) {
  return std::any_of(a.begin(), a.end(), [&](const auto& entry) {
    const auto other = b.find(entry.first);
    return other != b.end() && std::any_of(entry.second.begin(), entry.second.end(),
                                           [&](VertexId v) { return other->second.contains(v); });
  });
}

}  // namespace

bool SiteSolids::can_blend() const {
  const auto has_any = [&](bool host) {
    return std::any_of(solids.begin(), solids.end(),
                       [&](const FusionSolid& s) { return s.is_host == host && !s.triangles.empty(); });
  };
  return has_any(true) && has_any(false);
}

SiteSolids site_solids(const Graft& graft, const SiteGroup& group, const std::vector<PolygonMesh>& placed,
                       const std::vector<SourceSelection>& selections) {
  SiteSolids result;
  result.participants = participants_of(graft, group, placed, selections);
  for (const SiteParticipant& p : result.participants)
    result.solids.push_back(fusion_solid(placed[p.source.index()], p));
  return result;
}

std::vector<SiteGroup> group_sites(const Graft& graft, const std::vector<PolygonMesh>& placed,
                                   const std::vector<SourceSelection>& selections,
                                   std::span<const FieldOptions> options) {
  const std::size_t count = graft.sites.size();
  std::vector<std::map<SourceId, std::set<VertexId>>> touched(count);
  for (std::size_t k = 0; k < count; ++k)
    if (graft.sites[k].donor.is_valid())
      touched[k] = touched_vertices(graft, k, placed, selections, options[k]);
  std::vector<std::size_t> leader(count);
  std::iota(leader.begin(), leader.end(), std::size_t{0});
  for (std::size_t a = 0; a < count; ++a)
    for (std::size_t b = a + 1; b < count; ++b) {
      if (!meet(touched[a], touched[b])) continue;
      const std::size_t from = std::max(leader[a], leader[b]), to = std::min(leader[a], leader[b]);
      std::replace(leader.begin(), leader.end(), from, to);
    }
  std::vector<SiteGroup> groups;
  for (std::size_t k = 0; k < count; ++k) {
    if (leader[k] != k) continue;
    SiteGroup& group = groups.emplace_back();
    for (std::size_t other = k; other < count; ++other)
      if (leader[other] == k) group.push_back(other);
  }
  return groups;
}

}  // namespace skinforge
