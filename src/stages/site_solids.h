#pragma once

#include <vector>

#include "skeleton/graft.h"
#include "surface/site_field.h"

namespace skinforge {

/// Who takes part in one site of a graft, and what each brings into its field.
struct SiteSolids {
  std::vector<SiteParticipant> participants;
  std::vector<FusionSolid> solids;  ///< one per participant
  BlendOperator blend = BlendOperator::Blend;

  /// Whether there are two sides with something to blend.
  bool can_blend() const;
};

/// Replace: every source that the operation cuts, and the donor, by their presence. Attach: the host as it is
/// and the donor's sub-tree, closed, as a union. Remove and Detach blend nothing: only the sources that are
/// cut.
SiteSolids site_solids(const Graft& graft, std::size_t site, const std::vector<PolygonMesh>& placed,
                       const std::vector<SourceSelection>& selections);

}  // namespace skinforge
