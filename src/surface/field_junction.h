#pragma once

#include <optional>
#include <string>

#include "surface/junction_loop.h"
#include "surface/kept_surface.h"
#include "surface/patch_parts.h"
#include "surface/site_field.h"

namespace skinforge {

/// The blended isosurface, extracted once for all attempts of one junction.
class FieldJunction {
 public:
  /// Refers to its arguments, which must outlive it.
  FieldJunction(const std::vector<JunctionLoop>& loops, const SiteField& field, const KeptSurface& kept);

  /// The isosurface trimmed clear of the preserved faces by `clearance` (a share of the full one) and zipped
  /// to the borders. None when a border has no ring of its own or the two sides stay apart; `fault` says
  /// which.
  std::optional<TrianglePatch> zipped(double clearance, std::string& fault) const;

  /// A tube of quads in the place of a part (`best_tube`); mirrored with `borders`.
  std::optional<QuadPatch> tube(const PatchPart& part, std::string& fault,
                                const PatchMirror* borders = nullptr) const;

  /// A zipped patch remeshed on the isosurface. `length_scale`: of the borders' edge lengths.
  TrianglePatch remeshed(const TrianglePatch& zipped, double length_scale) const;

 private:
  const std::vector<JunctionLoop>& loops_;
  const SiteField& field_;
  const KeptSurface& kept_;
  IsoSurface surface_;
};

}  // namespace skinforge
