#include "stages/inputs.h"
#include "stages/stages.h"

namespace skinforge {
namespace {

/// S_R: the operations carried out on the skeletons (Sec. 4).
class GraftSkeleton final : public Stage {
 public:
  GraftSkeleton(ArtifactNames names, const Recipe& recipe)
      : names_(std::move(names)),
        inputs_(input_names(recipe)),
        base_(recipe.input_index(recipe.base)),
        place_(recipe.place("/ops")) {}

  StageInfo info() const override {
    return {.name = "graft_skeleton",
            .version = 2,
            .reads = joined(character_names(names_, inputs_), {names_.placement()}),
            .writes = {names_.graft()}};
  }
  void add_to_key(Hasher& key) const override {
    key.add_value("inputs", inputs_);
    key.add_value("base", base_);
  }

  void run(const StageInput& in, StageOutput& out, IssueSink& issues) const override {
    const auto& placed = in.get<PlacedOperations>(names_.placement());
    const auto characters = get_characters(in, names_, inputs_);
    with_context(place_, [&] {
      out.put(names_.graft(),
              graft_skeletons(skeletons_of(characters), inputs_, base_, placed.operations, issues));
    });
  }

 private:
  ArtifactNames names_;
  std::vector<std::string> inputs_;
  std::size_t base_;
  std::string place_;  // leads error messages only; failures are never stored
};

}  // namespace

StagePointer make_graft_skeleton_stage(const ArtifactNames& names, const Recipe& recipe) {
  return std::make_unique<GraftSkeleton>(names, recipe);
}

}  // namespace skinforge
