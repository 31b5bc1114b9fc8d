#include "stages/stages.h"

namespace skinforge {
namespace {

/// Takes the finished character of another recipe as an input.
class Adopt final : public Stage {
 public:
  Adopt(ArtifactNames names, std::string result, std::string input)
      : names_(std::move(names)), result_(std::move(result)), input_(std::move(input)) {}

  StageInfo info() const override {
    return {.name = "adopt",
            .instance = input_,
            .version = 1,
            .reads = {result_},
            .writes = {names_.imported(input_), names_.contents(input_)}};
  }
  void add_to_key(Hasher& key) const override { key.add("input", input_); }

  void run(const StageInput& in, StageOutput& out, IssueSink&) const override {
    Character character = in.get<Character>(result_);
    character.name = input_;
    InputContents contents{character.skeleton.names(), {}};
    for (const Clip& clip : character.clips) contents.clips.push_back(clip.name);
    out.put(names_.imported(input_), std::move(character));
    out.put(names_.contents(input_), std::move(contents));
  }

 private:
  ArtifactNames names_;
  std::string result_;
  std::string input_;
};

}  // namespace

StagePointer make_adopt_stage(const ArtifactNames& names, const ArtifactNames& nested,
                              const std::string& input) {
  return std::make_unique<Adopt>(names, nested.result(), input);
}

}  // namespace skinforge
