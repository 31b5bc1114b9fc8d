#pragma once

#include <string>
#include <vector>

#include "surface/arc_strip.h"
#include "surface/junction_faults.h"
#include "surface/junction_loop.h"
#include "surface/kept_surface.h"
#include "surface/patch_mirror.h"
#include "surface/site_field.h"

namespace skinforge {

/// How a junction was made: the ladder of junction.md, best rung first.
enum class JunctionRung : std::uint8_t {
  Tube,    ///< quads from border to border on the blended field (rung 2)
  Field,   ///< isosurface of the blended field, zipped to the borders (rung 1)
  Bridge,  ///< the borders zipped directly, the strip remeshed and faired
  Cap,     ///< each border closed on its own
  Strip,   ///< only borders that end on open hems, joined by strips
  None,    ///< no border: parts without a cut loop are joined rigidly
};

/// What mirroring makes of a junction (junction.md d.1).
struct JunctionSymmetry {
  std::int32_t site = -1;  ///< the junction that it maps onto, itself or another; -1: it is not symmetric
  std::string reason;      ///< why not
  double matched = 0;      ///< share of the base's vertices that have an image; 0 without a plane
  PatchMirror borders;     ///< per border vertex its image among those of junction `site`

  template <class Archive>
  friend void fields(Archive& a, JunctionSymmetry& s) {
    a(s.site, s.reason, s.matched, s.borders.plane, s.borders.image);
  }
};

/// M_J for one operation (SkinMixer Sec. 6.1): triangles whose fixed vertices are the vertices of `loops`,
/// loop after loop.
struct Junction {
  std::vector<JunctionLoop> loops;
  TrianglePatch patch;
  std::size_t quads = 0;  ///< triangles 2 k and 2 k + 1 are halves of a quad, for k below this (`halved`)
  JunctionRung rung = JunctionRung::None;
  std::string reason;  ///< why not a better rung; empty where nothing better was asked
  double voxel = 0;    ///< metres; 0 without a field
  std::vector<ArcStrip> strips;
  JunctionFaults faults;  ///< of the patch and the strips
  JunctionSymmetry symmetry;

  bool is_empty() const { return patch.triangles.empty() && strips.empty(); }

  template <class Archive>
  friend void fields(Archive& a, Junction& j) {
    a(j.loops, j.patch.positions, j.patch.triangles, j.patch.fixed, j.quads, j.rung, j.reason, j.voxel,
      j.strips, j.faults, j.symmetry);
  }
};

/// Builds the surface between the loops, clear of `kept`. Watertight on every rung, because loops enter as
/// indices and every ring is closed by triangles that use each of its edges exactly once. Rungs are tried
/// from the best; the first without a fault (`faults_of`) is taken, or the one with least: a bridge or caps
/// may only stand in for a field that gives a surface if they join every border, too. `mirror`: per border
/// vertex its image where the junction is its own image; what is made is symmetric then wherever a rung can
/// be.
Junction build_junction(std::vector<JunctionLoop> loops, const SiteField& field, const KeptSurface& kept,
                        const PatchMirror* mirror = nullptr);

/// The mirror image of a junction, between loops that are the images of its own: `borders` says which vertex
/// goes where.
Junction mirrored_junction(const Junction& junction, const PatchMirror& borders,
                           std::vector<JunctionLoop> loops);

}  // namespace skinforge
