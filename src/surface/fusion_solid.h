#pragma once

#include <span>
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
  bool is_host = false;          ///< the operation cuts it or grafts onto it; false for a donor
  bool is_added = false;         ///< the donor of an addition
  TriangleBvh bvh{{}, {}};
};

/// How one source takes part in one site.
struct SiteParticipant {
  SourceId source;
  bool is_host = false;   ///< the operation cuts it or grafts onto it; false for a donor
  bool is_added = false;  ///< the donor of an addition
  std::vector<double>
      presence;    ///< #V, with regard to this site alone (all 1 when the site does not cut this source)
  FaceSet fusing;  ///< #F, faces of the components that are fused; others are kept or dropped whole

  template <class Archive>
  friend void fields(Archive& a, SiteParticipant& p) {
    a(p.source, p.is_host, p.is_added, p.presence, p.fusing);
  }
};

/// The participant that the cuts of some sites make: the least of their presences, and the components that
/// they blend (Sec. 6, "Removal of secondary components").
SiteParticipant cut_participant(SourceId source, const SourceSelection& selection,
                                std::span<const std::size_t> sites);

/// Lets the host of an addition take part with the component nearest to `where` among those that are not
/// dropped, too.
void fuse_component_near(SiteParticipant& host, const PolygonMesh& mesh, const SourceSelection& selection,
                         const Vec3& where);

/// The solid that a participant brings; may be empty. Whole, with the parts that the operation discards,
/// because Eq. 1 fades them out by their presence; but of the donor of an addition only the faces of some
/// presence, with flat caps over the openings: nothing fades there.
FusionSolid fusion_solid(const PolygonMesh& mesh, const SiteParticipant& participant);

}  // namespace skinforge
