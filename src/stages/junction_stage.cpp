#include <fmt/format.h>

#include <algorithm>

#include "stages/junction_rounds.h"
#include "stages/stages.h"
#include "stages/surface_options.h"
#include "surface/junction_smoothing.h"

namespace skinforge {
namespace {

/// M_J of every operation, and M_R (Sec. 6.1).
class MakeJunctions final : public Stage {
 public:
  MakeJunctions(ArtifactNames names, const Recipe& recipe)
      : names_(std::move(names)), site_count_(recipe.operations.size()) {
    for (const RecipeOperation& operation : recipe.operations) {
      elements_.push_back(junction_elements(operation.surface));
      smoothing_.push_back(operation.surface.smoothing);
    }
  }

  StageInfo info() const override {
    StageInfo info{.name = "junction",
                   .version = 9,
                   .reads = {names_.graft(), names_.placed(), names_.selection(), names_.groups()},
                   .writes = {names_.surface()}};
    for (std::size_t k = 0; k < site_count_; ++k) info.reads.push_back(names_.field(k));
    return info;
  }
  void add_to_key(Hasher& key) const override {
    key.add_value("options", options_);
    key.add_value("elements", elements_);
    key.add_value("smoothing", smoothing_);
  }

  void run(const StageInput& in, StageOutput& out, IssueSink& issues) const override {
    const auto& placed = in.get<std::vector<PolygonMesh>>(names_.placed());
    const auto& selections = in.get<std::vector<SourceSelection>>(names_.selection());
    const std::vector<JunctionSite> sites = sites_of(in, placed, selections);
    std::vector<PreservedSource> sources;
    for (std::size_t s = 0; s < placed.size(); ++s) sources.push_back({&placed[s], selections[s]});
    JunctionRound best = make_junctions(sites, std::move(sources), site_count_, options_);
    smooth(best, issues);
    for (const JunctionSite& site : sites)
      tell(best.junctions[site.first()], site.first(), best.arcs[site.first()], issues);
    SurfaceResult result;
    result.joined = assemble_surface(best.sources, best.junctions, elements_);
    result.junctions = std::move(best.junctions);
    result.arcs = std::move(best.arcs);
    for (PreservedSource& source : best.sources) result.kept.push_back(std::move(source.selection.kept));
    out.put(names_.surface(), std::move(result));
  }

 private:
  std::vector<JunctionSite> sites_of(const StageInput& in, const std::vector<PolygonMesh>& placed,
                                     const std::vector<SourceSelection>& selections) const {
    std::vector<JunctionSite> sites;
    for (const SiteGroup& group : in.get<std::vector<SiteGroup>>(names_.groups()))
      sites.push_back({group, site_solids(in.get<Graft>(names_.graft()), group, placed, selections),
                       &in.get<SiteField>(names_.field(group.front()))});
    return sites;
  }

  void smooth(JunctionRound& round, IssueSink& issues) const {
    if (std::all_of(smoothing_.begin(), smoothing_.end(), [](int rounds) { return rounds == 0; })) return;
    const KeptSurface kept = kept_surface(round.sources);
    for (std::size_t k = 0; k < site_count_; ++k) {
      if (smoothing_[k] == 0 || round.junctions[k].patch.triangles.empty()) continue;
      const int made = smooth_junction(round.junctions[k], kept, smoothing_[k]);
      if (made < smoothing_[k])
        issues.note("smoothing-limited", fmt::format("op {}", k + 1),
                    fmt::format("{} of {} smoothing rounds made; more would fold or cut the surface", made,
                                smoothing_[k]));
    }
  }

  static void tell(const Junction& junction, std::size_t site, int arcs, IssueSink& issues) {
    const std::string place = fmt::format("op {}", site + 1);
    if (junction.rung == JunctionRung::None) issues.note("joined-rigidly", place, junction.reason);
    if (junction.rung == JunctionRung::Bridge ||
        (junction.rung == JunctionRung::Cap && !junction.reason.empty()))
      issues.warn("junction-fallback", place, junction.reason);
    if (junction.faults.any()) issues.warn("junction-faults", place, describe(junction.faults));
    if (arcs > 0)
      issues.warn("border-arc-open", place,
                  fmt::format("{} borders end on an open hem of the input and are left open", arcs));
  }

  ArtifactNames names_;
  std::size_t site_count_;
  PreserveOptions options_;
  std::vector<JunctionElements> elements_;  // per operation
  std::vector<int> smoothing_;              // per operation, rounds
};

}  // namespace

StagePointer make_junction_stage(const ArtifactNames& names, const Recipe& recipe) {
  return std::make_unique<MakeJunctions>(names, recipe);
}

}  // namespace skinforge
