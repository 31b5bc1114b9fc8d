#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "base/id.h"
#include "geometry/edges.h"
#include "surface/junction_loop.h"
#include "surface/selection.h"
#include "surface/site_field.h"

namespace skinforge {

/// One placed source with what stays of it. Indexed by SourceId.
struct PreservedSource {
  const PolygonMesh* mesh;                ///< placed
  SourceSelection selection;              ///< `kept` and `face_site` are worked on
  std::shared_ptr<const EdgeList> edges;  ///< of the mesh

  PreservedSource(const PolygonMesh* placed, SourceSelection selected)
      : mesh(placed),
        selection(std::move(selected)),
        edges(std::make_shared<const EdgeList>(build_edges(*placed))) {}
};

struct PreserveOptions {
  double moved_voxels =
      0.05;  ///< junction.md a.3: a kept face goes where the blended surface leaves it by this much
  /// Rings of faces that a host gives up around those that an added part moves: room in which rows can meet.
  /// Departure: the program of the paper's authors gives up two on either side.
  int added_rings = 1;
  int least_faces = 4;  ///< ours: smaller groups of kept faces at a border are crumbs
  double straighten_share =
      0.15;  ///< junction.md b.0: at most this share of a source's border faces is given up ...
  int straighten_least = 6;  ///< ... but always up to this many faces per border

  template <class Archive>
  friend void fields(Archive& a, PreserveOptions& o) {
    a(o.moved_voxels, o.added_rings, o.least_faces, o.straighten_share, o.straighten_least);
  }
};

/// Discards kept fused faces of the participants whose vertices do not lie on the blended surface of the
/// site: inside the other part, or in a fillet; around an added part some more. `solids`: one per
/// participant.
void discard_moved_faces(std::span<PreservedSource> sources, std::span<const SiteParticipant> participants,
                         const std::vector<FusionSolid>& solids, const SiteField& field, std::size_t site,
                         const PreserveOptions& options);

/// Discards preserved faces, if they belong to components that a participant fuses; returns how many.
std::size_t discard_faces(std::span<PreservedSource> sources, std::span<const SiteParticipant> participants,
                          std::span<const std::pair<SourceId, FaceId>> faces, std::size_t site);

/// Makes the borders of every source clean: opening, crumbs, straightening, pinches (SkinMixer Sec. 6,
/// junction.md b.0). Each face discarded here goes to the site of its discarded neighbours. A source
/// of which nothing would be left keeps its ragged border.
void clean_borders(PreservedSource& source, const PreserveOptions& options);

/// The closed borders that belong to one of `sites`. Arcs that end on an original open border are added to
/// `arcs`.
std::vector<JunctionLoop> loops_of_sites(const PreservedSource& source, SourceId id,
                                         std::span<const std::size_t> sites, bool is_host,
                                         std::vector<JunctionLoop>& arcs);

}  // namespace skinforge
