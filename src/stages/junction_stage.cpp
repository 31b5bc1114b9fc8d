#include <fmt/format.h>

#include "stages/site_solids.h"
#include "stages/stages.h"

namespace skinforge {
namespace {

/// M_J of every operation, and M_R (Sec. 6.1).
class MakeJunctions final : public Stage {
 public:
  MakeJunctions(ArtifactNames names, const Recipe& recipe)
      : names_(std::move(names)), site_count_(recipe.operations.size()) {}

  StageInfo info() const override {
    StageInfo info{.name = "junction",
                   .version = 1,
                   .reads = {names_.graft(), names_.placed(), names_.selection(), names_.groups()},
                   .writes = {names_.surface()}};
    for (std::size_t k = 0; k < site_count_; ++k) info.reads.push_back(names_.field(k));
    return info;
  }
  void add_to_key(Hasher& key) const override { key.add_value("options", options_); }

  void run(const StageInput& in, StageOutput& out, IssueSink& issues) const override {
    const auto& graft = in.get<Graft>(names_.graft());
    const auto& placed = in.get<std::vector<PolygonMesh>>(names_.placed());
    const auto& selections = in.get<std::vector<SourceSelection>>(names_.selection());
    const auto& groups = in.get<std::vector<SiteGroup>>(names_.groups());
    std::vector<PreservedSource> sources;
    for (std::size_t s = 0; s < placed.size(); ++s) sources.push_back({&placed[s], selections[s]});
    std::vector<SiteSolids> solids;
    for (const SiteGroup& group : groups) {
      solids.push_back(site_solids(graft, group, placed, selections));
      discard_moved_faces(sources, solids.back().participants, solids.back().solids,
                          in.get<SiteField>(names_.field(group.front())), group.front(), options_);
    }
    for (PreservedSource& source : sources) clean_borders(source, options_);
    const KeptSurface kept = kept_surface(sources);
    SurfaceResult result;
    result.junctions.resize(site_count_);
    result.arcs.resize(site_count_, 0);
    for (std::size_t g = 0; g < groups.size(); ++g) {
      const std::size_t first = groups[g].front();
      result.junctions[first] =
          build_junction(loops_of(sources, solids[g].participants, groups[g], result.arcs[first]),
                         in.get<SiteField>(names_.field(first)), kept);
      for (const std::size_t other : groups[g])
        if (other != first)
          result.junctions[other].reason = fmt::format("joined in the junction of operation {}", first + 1);
      tell(result.junctions[first], first, result.arcs[first], issues);
    }
    result.joined = assemble_surface(sources, result.junctions);
    for (PreservedSource& source : sources) result.kept.push_back(std::move(source.selection.kept));
    out.put(names_.surface(), std::move(result));
  }

 private:
  static std::vector<JunctionLoop> loops_of(std::span<const PreservedSource> sources,
                                            std::span<const SiteParticipant> participants,
                                            const SiteGroup& group, int& arcs) {
    std::vector<JunctionLoop> loops;
    for (const SiteParticipant& p : participants) {
      auto found = loops_of_sites(sources[p.source.index()], p.source, group, p.is_host, arcs);
      loops.insert(loops.end(), std::make_move_iterator(found.begin()), std::make_move_iterator(found.end()));
    }
    return loops;
  }

  static void tell(const Junction& junction, std::size_t site, int arcs, IssueSink& issues) {
    const std::string place = fmt::format("op {}", site + 1);
    if (junction.rung == JunctionRung::None) issues.note("joined-rigidly", place, junction.reason);
    if (junction.rung == JunctionRung::Bridge ||
        (junction.rung == JunctionRung::Cap && !junction.reason.empty()))
      issues.warn("junction-fallback", place, junction.reason);
    if (arcs > 0)
      issues.warn("border-arc-open", place,
                  fmt::format("{} borders end on an open hem of the input and are left open", arcs));
  }

  ArtifactNames names_;
  std::size_t site_count_;
  PreserveOptions options_;
};

}  // namespace

StagePointer make_junction_stage(const ArtifactNames& names, const Recipe& recipe) {
  return std::make_unique<MakeJunctions>(names, recipe);
}

}  // namespace skinforge
