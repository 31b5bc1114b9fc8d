#include "stages/site_solids.h"

#include <algorithm>
#include <set>

#include "surface/cut_line.h"

namespace skinforge {
namespace {

Vec3 donor_centre(const Graft& graft, const GraftSite& site, const PolygonMesh& donor_mesh,
                  const SiteParticipant& donor) {
  if (const auto cut = longest_cut_line(donor_mesh, donor.presence)) return cut->centre;
  return graft.skeleton[site.fused].joint_from_model.inverse().translation();
}

std::vector<SiteParticipant> participants_of(const Graft& graft, std::size_t k,
                                             const std::vector<PolygonMesh>& placed,
                                             const std::vector<SourceSelection>& selections) {
  const GraftSite& site = graft.sites[k];
  std::vector<SiteParticipant> participants;
  std::set<SourceId> hosts;
  for (const auto& [source, joint] : site.removed)
    if (source != site.donor) hosts.insert(source);
  for (const SourceId host : hosts)
    participants.push_back(cut_participant(host, selections[host.index()], k, true));
  if (!site.donor.is_valid()) return participants;
  const std::size_t d = site.donor.index();
  SiteParticipant donor = cut_participant(site.donor, selections[d], k, false);
  if (site.kind == GraftKind::Attach)
    participants.push_back(host_participant(site.host, placed[site.host.index()],
                                            selections[site.host.index()],
                                            donor_centre(graft, site, placed[d], donor)));
  participants.push_back(std::move(donor));
  return participants;
}

}  // namespace

bool SiteSolids::can_blend() const {
  const auto has_any = [&](bool host) {
    return std::any_of(solids.begin(), solids.end(),
                       [&](const FusionSolid& s) { return s.is_host == host && !s.triangles.empty(); });
  };
  return has_any(true) && has_any(false);
}

SiteSolids site_solids(const Graft& graft, std::size_t site, const std::vector<PolygonMesh>& placed,
                       const std::vector<SourceSelection>& selections) {
  SiteSolids result;
  result.blend = graft.sites[site].kind == GraftKind::Attach ? BlendOperator::Union : BlendOperator::Blend;
  const SolidExtent extent = result.blend == BlendOperator::Union ? SolidExtent::Trimmed : SolidExtent::Whole;
  result.participants = participants_of(graft, site, placed, selections);
  for (const SiteParticipant& p : result.participants)
    result.solids.push_back(fusion_solid(placed[p.source.index()], p, extent));
  return result;
}

}  // namespace skinforge
