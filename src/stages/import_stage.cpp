#include <fmt/format.h>

#include <algorithm>

#include "geometry/quad_pairing.h"
#include "stages/clip_limits.h"
#include "stages/clip_merge.h"
#include "stages/stages.h"

namespace skinforge {
namespace {

/// Reads one input and the files that bring further clips for it; quads are recovered where the format has
/// none.
class Import final : public Stage {
 public:
  Import(ArtifactNames names, ImportParameters parameters)
      : names_(std::move(names)), parameters_(std::move(parameters)) {}

  StageInfo info() const override {
    StageInfo info{.name = "import",
                   .instance = parameters_.input,
                   .version = 1,
                   .reads = {},
                   .writes = {names_.imported(parameters_.input), names_.contents(parameters_.input)}};
    std::size_t count = 0;
    for (const auto& files : parameters_.file_names) count += files.size();
    for (std::size_t i = 0; i < count; ++i) info.reads.push_back(names_.file(parameters_.input, i));
    return info;
  }

  // Names of files are part of the key: they stand in issues, and choose the reader. So is the input's name:
  // the character bears it.
  void add_to_key(Hasher& key) const override {
    key.add("input", parameters_.input);
    key.add_value("files", parameters_.file_names);
  }

  void run(const StageInput& in, StageOutput& out, IssueSink& issues) const override {
    std::size_t next = 0;
    Character character = read(in, parameters_.file_names.front(), next, issues);
    for (std::size_t i = 1; i < parameters_.file_names.size(); ++i)
      merge_clips(character, read(in, parameters_.file_names[i], next, issues),
                  parameters_.file_names[i].front(), issues);
    expect_clips_in_limits(character);
    character.name = parameters_.input;
    character.mesh = recover_quads(character.mesh);
    InputContents contents{character.skeleton.names(), {}, source_files(in)};
    for (const Clip& clip : character.clips) contents.clips.push_back(clip.name);
    out.put(names_.imported(parameters_.input), std::move(character));
    out.put(names_.contents(parameters_.input), std::move(contents));
  }

 private:
  std::vector<SourceFile> source_files(const StageInput& in) const {
    std::vector<SourceFile> sources;
    for (const auto& files : parameters_.file_names)
      for (const std::string& name : files) {
        const std::string artifact = names_.file(parameters_.input, sources.size());
        sources.push_back({name, in.digest(artifact), in.get<Bytes>(artifact).size()});
      }
    return sources;
  }

  Character read(const StageInput& in, const std::vector<std::string>& file_names, std::size_t& next,
                 IssueSink& issues) const {
    std::vector<InputFile> files;
    for (const std::string& name : file_names) {
      const std::string artifact = names_.file(parameters_.input, next++);
      files.push_back({name, in.get<Bytes>(artifact), in.digest(artifact)});
    }
    return build_character(read_scene(files), file_names.front(), issues);
  }

  ArtifactNames names_;
  ImportParameters parameters_;
};

}  // namespace

StagePointer make_import_stage(const ArtifactNames& names, ImportParameters parameters) {
  return std::make_unique<Import>(names, std::move(parameters));
}

}  // namespace skinforge
