#pragma once

#include <optional>
#include <string>

#include "surface/junction_loop.h"
#include "surface/kept_surface.h"
#include "surface/site_field.h"

namespace skinforge {

/// The blended isosurface, extracted once for all attempts of one junction.
class FieldJunction {
 public:
  /// Refers to its arguments, which must outlive it.
  FieldJunction(const std::vector<JunctionLoop>& loops, const SiteField& field, const KeptSurface& kept);

  /// The isosurface trimmed clear of the preserved faces by `share` of the full clearance, zipped to the
  /// borders and remeshed. None when a border has no ring of its own or the two sides stay apart; `fault`
  /// then says which.
  std::optional<TrianglePatch> at_clearance(double share, std::string& fault) const;

 private:
  const std::vector<JunctionLoop>& loops_;
  const SiteField& field_;
  const KeptSurface& kept_;
  IsoSurface surface_;
};

}  // namespace skinforge
