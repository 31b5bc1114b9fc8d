#pragma once

#include <vector>

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

/// The solid of `mesh` for a site; `presence` per vertex (all 1 when the site does not cut this source).
/// Components kept or dropped whole are left out (Sec. 6, "Removal of secondary components"). May be empty.
FusionSolid fusion_solid(const PolygonMesh& mesh, const SourceSelection& selection,
                         const std::vector<double>& presence, bool is_host, SolidExtent extent);

}  // namespace skinforge
