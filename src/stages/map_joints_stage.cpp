#include "skeleton/joint_map.h"
#include "stages/inputs.h"
#include "stages/stages.h"

namespace skinforge {
namespace {

/// B_k: from every source into the grafted skeleton (Sec. 5).
class MapJoints final : public Stage {
 public:
  MapJoints(ArtifactNames names, const Recipe& recipe)
      : names_(std::move(names)), inputs_(input_names(recipe)) {}

  StageInfo info() const override {
    return {.name = "map_joints",
            .version = 1,
            .reads = joined(character_names(names_, inputs_), {names_.graft()}),
            .writes = {names_.joint_maps()}};
  }
  void add_to_key(Hasher&) const override {}

  void run(const StageInput& in, StageOutput& out, IssueSink&) const override {
    const auto characters = get_characters(in, names_, inputs_);
    out.put(names_.joint_maps(), build_joint_maps(skeletons_of(characters), in.get<Graft>(names_.graft())));
  }

 private:
  ArtifactNames names_;
  std::vector<std::string> inputs_;
};

}  // namespace

StagePointer make_map_joints_stage(const ArtifactNames& names, const Recipe& recipe) {
  return std::make_unique<MapJoints>(names, recipe);
}

}  // namespace skinforge
