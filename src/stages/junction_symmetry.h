#pragma once

#include <string>

#include "stages/site_solids.h"
#include "surface/junction.h"
#include "surface/source_mirror.h"

namespace skinforge {

/// Everything that one junction of a build is made from.
struct JunctionSite {
  SiteGroup group;
  SiteSolids solids;
  const SiteField* field = nullptr;

  std::size_t first() const { return group.front(); }
};

/// The closed borders of a junction; those that end on open hems are added to `arcs`.
std::vector<JunctionLoop> loops_of(std::span<const PreservedSource> sources, const JunctionSite& site,
                                   std::vector<JunctionLoop>& arcs);

/// What of a build is mirror symmetric (junction.md d.1): which junctions are their own images, and which
/// each other's.
class BuildSymmetry {
 public:
  /// By the sources' shapes, places and presences. Refers to `sites`.
  BuildSymmetry(const std::vector<JunctionSite>& sites, std::span<const PreservedSource> sources);

  /// Makes the borders of all sources clean, the same on both sides where the sides are the same. A junction
  /// whose borders come out unlike for all that (faces without image) counts as not symmetric from then on.
  std::vector<PreservedSource> cleaned(std::vector<PreservedSource> sources, const PreserveOptions& options);

  /// Of the junction of `site` with these borders among the borders of all.
  JunctionSymmetry of(const JunctionSite& site, std::span<const PreservedSource> sources) const;

 private:
  void give_up(std::size_t site, const std::string& reason);
  const JunctionSite& site_with(std::int32_t first) const;

  const std::vector<JunctionSite>& sites_;
  std::optional<SourceMirror> mirror_;
  std::vector<std::int32_t> image_;  // per operation the first one of its junction's image; -1
  std::vector<std::string> reason_;  // per operation: why there is none
};

}  // namespace skinforge
