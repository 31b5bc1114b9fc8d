#include <fmt/format.h>

#include "base/parallel.h"
#include "stages/inputs.h"
#include "stages/loose_parts_issues.h"
#include "stages/placed_sources.h"
#include "stages/site_solids.h"
#include "stages/stages.h"
#include "stages/surface_options.h"
#include "surface/selection.h"

namespace skinforge {
namespace {

/// Presence, preserved faces and secondary components of every source (Sec. 6).
class Select final : public Stage {
 public:
  Select(ArtifactNames names, const Recipe& recipe) : names_(std::move(names)), inputs_(input_names(recipe)) {
    for (const RecipeOperation& operation : recipe.operations) {
      options_.push_back(cut_options(operation.surface));
      field_options_.push_back(field_options(operation));
    }
  }

  StageInfo info() const override {
    return {.name = "select",
            .version = 3,
            .reads = joined(character_names(names_, inputs_), {names_.placement(), names_.graft()}),
            .writes = {names_.placed(), names_.selection(), names_.groups()}};
  }
  void add_to_key(Hasher& key) const override {
    key.add_value("options", options_);
    key.add_value("field", field_options_);
  }

  void run(const StageInput& in, StageOutput& out, IssueSink& issues) const override {
    const auto characters = get_characters(in, names_, inputs_);
    const auto& placement = in.get<PlacedOperations>(names_.placement());
    const auto& graft = in.get<Graft>(names_.graft());
    std::vector<PolygonMesh> placed;
    std::vector<SourceSelection> selections;
    for (std::size_t s = 0; s < graft.sources.size(); ++s) {
      const GraftSource& source = graft.sources[s];
      const Character& character = *characters[source.input];
      placed.push_back(place_mesh(character, graft, SourceId(s), placement));
      const std::vector<Cut> cuts = cuts_of_source(graft, character.skeleton, SourceId(s), options_);
      selections.push_back(select_faces(placed.back(), character.weights, cuts,
                                        fmt::format("input {}", inputs_[source.input]), issues));
      tell_loose_parts(graft, SourceId(s), character, selections.back(), inputs_[source.input], issues);
    }
    out.put(names_.groups(), group_sites(graft, placed, selections, field_options_));
    out.put(names_.placed(), std::move(placed));
    out.put(names_.selection(), std::move(selections));
  }

 private:
  ArtifactNames names_;
  std::vector<std::string> inputs_;
  std::vector<CutOptions> options_;  // per operation, as all here
  std::vector<FieldOptions> field_options_;
};

}  // namespace

StagePointer make_select_stage(const ArtifactNames& names, const Recipe& recipe) {
  return std::make_unique<Select>(names, recipe);
}

}  // namespace skinforge
