#include "stages/inputs.h"
#include "stages/stages.h"

namespace skinforge {
namespace {

/// Takes the finished character of another recipe as an input.
class Adopt final : public Stage {
 public:
  Adopt(ArtifactNames names, const ArtifactNames& nested, const RecipeInput& input)
      : names_(std::move(names)), result_(nested.result()), input_(input.name) {
    for (const RecipeInput& inner : input.recipe->inputs) contents_.push_back(nested.contents(inner.name));
  }

  StageInfo info() const override {
    return {.name = "adopt",
            .instance = input_,
            .version = 1,
            .reads = joined({result_}, contents_),
            .writes = {names_.imported(input_), names_.contents(input_)}};
  }
  void add_to_key(Hasher& key) const override { key.add("input", input_); }

  void run(const StageInput& in, StageOutput& out, IssueSink&) const override {
    Character character = in.get<Character>(result_);
    character.name = input_;
    InputContents contents{character.skeleton.names(), {}, {}};
    for (const Clip& clip : character.clips) contents.clips.push_back(clip.name);
    for (const std::string& inner : contents_) {
      const auto& files = in.get<InputContents>(inner).files;
      contents.files.insert(contents.files.end(), files.begin(), files.end());
    }
    out.put(names_.imported(input_), std::move(character));
    out.put(names_.contents(input_), std::move(contents));
  }

 private:
  ArtifactNames names_;
  std::string result_;
  std::string input_;
  std::vector<std::string> contents_;  // of the inputs of that recipe
};

}  // namespace

StagePointer make_adopt_stage(const ArtifactNames& names, const ArtifactNames& nested,
                              const RecipeInput& input) {
  return std::make_unique<Adopt>(names, nested, input);
}

}  // namespace skinforge
