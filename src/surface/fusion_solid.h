#pragma once

#include <vector>

#include "base/id.h"
#include "geometry/triangle_bvh.h"
#include "surface/selection.h"
#include "surface/triangle_patch.h"

namespace skinforge {

/// What one source brings into the field of one site: the triangles of its blended components, ready for
/// queries.
struct FusionSolid {
  std::vector<Vec3> positions;  ///< placed, metres
  std::vector<Triangle> triangles;
  std::vector<double> presence;  ///< per vertex, with regard to this site alone
  bool is_host = false;          ///< the operation cuts it or grafts onto it; false for the donor
  TriangleBvh bvh{{}, {}};
};

enum class SolidExtent {
  Whole,    ///< with the parts that the operation discards: Eq. 1 fades them out by their presence
  Trimmed,  ///< only faces of some presence, the openings closed by flat caps: for unions, where nothing
            ///< fades
};

/// How one source takes part in one site.
struct SiteParticipant {
  SourceId source;
  bool is_host = false;  ///< the operation cuts it or grafts onto it; false for the donor
  std::vector<double>
      presence;    ///< #V, with regard to this site alone (all 1 when the site does not cut this source)
  FaceSet fusing;  ///< #F, faces of the components that are fused; others are kept or dropped whole

  template <class Archive>
  friend void fields(Archive& a, SiteParticipant& p) {
    a(p.source, p.is_host, p.presence, p.fusing);
  }
};

/// The participant that a cut makes: its site presence, and the components that the cut blends (Sec. 6,
/// "Removal of secondary components").
SiteParticipant cut_participant(SourceId source, const SourceSelection& selection, std::size_t site,
                                bool is_host);

/// The participant that an addition makes of its host: wholly present; fused is the component nearest to
/// `where` among those that are not dropped.
SiteParticipant host_participant(SourceId source, const PolygonMesh& mesh, const SourceSelection& selection,
                                 const Vec3& where);

/// The solid that a participant brings. May be empty.
FusionSolid fusion_solid(const PolygonMesh& mesh, const SiteParticipant& participant, SolidExtent extent);

}  // namespace skinforge
