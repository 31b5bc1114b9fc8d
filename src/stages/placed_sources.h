#pragma once

#include <span>
#include <vector>

#include "recipe/recipe.h"
#include "stages/artifacts.h"
#include "surface/selection.h"

/// The inputs where the operations put them, and where those cut them.
namespace skinforge {

/// How one operation cuts its two sides.
struct CutOptions {
  SelectionOptions at, from;
  Sides<bool> include_parent;

  template <class Archive>
  friend void fields(Archive& a, CutOptions& o) {
    a(o.at, o.from, o.include_parent);
  }
};

CutOptions cut_options(const SurfaceOptions& surface);

/// The input's mesh where its source goes; a shift moves each vertex with its joints (Sec. 4.1).
PolygonMesh place_mesh(const Character& character, const Graft& graft, SourceId source,
                       const PlacedOperations& placement);

/// The joints that each operation takes from a source, or leaves behind of a donor, by operation. `options`:
/// one per operation.
std::vector<Cut> cuts_of_source(const Graft& graft, const Skeleton& skeleton, SourceId source,
                                std::span<const CutOptions> options);

}  // namespace skinforge
