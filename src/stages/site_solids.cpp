#include "stages/site_solids.h"

#include <algorithm>
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

bool share_a_host(const Graft& graft, std::size_t a, std::size_t b) {
  const auto touched = [&](std::size_t k) {
    std::set<SourceId> sources{graft.sites[k].host};
    for (const auto& [source, joint] : graft.sites[k].removed) sources.insert(source);
    return sources;
  };
  const std::set<SourceId> first = touched(a);
  const std::set<SourceId> second = touched(b);
  return std::any_of(first.begin(), first.end(), [&](SourceId s) { return second.contains(s); });
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
                                   const std::vector<SourceSelection>& selections) {
  const std::size_t count = graft.sites.size();
  std::vector<Eigen::AlignedBox3d> regions;
  for (std::size_t k = 0; k < count; ++k)
    regions.push_back(affected_region(site_solids(graft, {k}, placed, selections).solids));
  std::vector<std::size_t> leader(count);
  std::iota(leader.begin(), leader.end(), std::size_t{0});
  for (std::size_t a = 0; a < count; ++a)
    for (std::size_t b = a + 1; b < count; ++b) {
      const bool both_bring = graft.sites[a].donor.is_valid() && graft.sites[b].donor.is_valid();
      if (!both_bring || !share_a_host(graft, a, b) || !regions[a].intersects(regions[b])) continue;
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
