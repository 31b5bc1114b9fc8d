#pragma once

#include <span>
#include <vector>

#include "skeleton/graft.h"
#include "surface/site_field.h"

namespace skinforge {

/// Sites that make one junction together, rising. Most stand alone; two limbs whose cuts run into each other
/// do not.
using SiteGroup = std::vector<std::size_t>;

/// Who takes part in one junction, and what each brings into its field.
struct SiteSolids {
  std::vector<SiteParticipant> participants;
  std::vector<FusionSolid> solids;  ///< one per participant

  /// Whether there are two sides with something to blend.
  bool can_blend() const;
};

/// Replace: every source that the operation cuts, and the donor, by their presence. Attach: the host as it is
/// and the donor's sub-tree, closed, as a union. Remove and Detach blend nothing: only the sources that are
/// cut.
SiteSolids site_solids(const Graft& graft, const SiteGroup& group, const std::vector<PolygonMesh>& placed,
                       const std::vector<SourceSelection>& selections);

/// Sites of one group: those that bring a part to the same source where their fields reach the same or
/// touching faces of it (Sec. 6.1: one field for a composite operation), because the holes that they make
/// would run into each other. Sorted by their first site; each site is in one group. `options`: per site.
std::vector<SiteGroup> group_sites(const Graft& graft, const std::vector<PolygonMesh>& placed,
                                   const std::vector<SourceSelection>& selections,
                                   std::span<const FieldOptions> options);

}  // namespace skinforge
