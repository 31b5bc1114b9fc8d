#include "stages/junction_trial.h"

#include <algorithm>

#include "stages/inputs.h"
#include "stages/junction_rounds.h"

namespace skinforge {
namespace {

const SiteGroup& group_of(const std::vector<SiteGroup>& groups, std::size_t site) {
  return *std::find_if(groups.begin(), groups.end(),
                       [&](const SiteGroup& g) { return std::find(g.begin(), g.end(), site) != g.end(); });
}

std::string fault_of(const Junction& junction) {
  if (junction.faults.any()) return describe(junction.faults);
  const bool is_joined = junction.rung != JunctionRung::Bridge && junction.rung != JunctionRung::Cap;
  return is_joined ? "" : junction.reason;
}

}  // namespace

Graft JunctionTrial::graft(const PlacedOperations& placed, std::size_t count) const {
  IssueSink unheard;  // the same operations run again, heard, in graft_skeleton
  return graft_skeletons(skeletons_of(setting_.characters), setting_.inputs, setting_.base,
                         std::span(placed.operations).first(count), unheard);
}

std::string JunctionTrial::fault(const PlacedOperations& placed, std::size_t site, BlendOperator op) const {
  const Graft grafted = graft(placed, site + 1);
  IssueSink unheard;  // as above, in select
  std::vector<PolygonMesh> meshes;
  std::vector<SourceSelection> selections;
  for (std::size_t s = 0; s < grafted.sources.size(); ++s) {
    const Character& character = *setting_.characters[grafted.sources[s].input];
    meshes.push_back(place_mesh(character, grafted, SourceId(s), placed));
    const std::vector<Cut> cuts = cuts_of_source(grafted, character.skeleton, SourceId(s), setting_.cuts);
    selections.push_back(select_faces(meshes.back(), character.weights, cuts, {}, unheard));
  }
  const auto groups = group_sites(grafted, meshes, selections, setting_.fields);
  const SiteGroup& group = group_of(groups, site);
  std::vector<JunctionSite> sites;
  sites.push_back({group, site_solids(grafted, group, meshes, selections), nullptr});
  if (!sites[0].solids.can_blend()) return {};
  FieldOptions options = setting_.fields[group.front()];
  options.blend.op = op;
  const SiteField field = build_site_field(sites[0].solids.solids, options);
  sites[0].field = &field;
  std::vector<PreservedSource> sources;
  for (std::size_t s = 0; s < meshes.size(); ++s) sources.push_back({&meshes[s], selections[s]});
  const JunctionRound round = make_junctions(sites, std::move(sources), site + 1, setting_.preserve);
  return fault_of(round.junctions[group.front()]);
}

}  // namespace skinforge
