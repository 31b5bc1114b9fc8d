#include "geometry/quad_pairing.h"
#include "stages/clip_limits.h"
#include "stages/rig_tables.h"
#include "stages/stages.h"

namespace skinforge {
namespace {

/// Takes the place of the import stage for an input whose skin is made here.
class Rig final : public Stage {
 public:
  Rig(ArtifactNames names, RigParameters parameters)
      : names_(std::move(names)), parameters_(std::move(parameters)) {}

  StageInfo info() const override {
    const std::string& input = parameters_.input;
    StageInfo info{.name = "rig",
                   .instance = input,
                   .version = 2,
                   .reads = {},
                   .writes = {names_.imported(input), names_.contents(input), names_.examples(input)}};
    for (std::size_t i = 0; i < parameters_.files.size(); ++i) info.reads.push_back(names_.file(input, i));
    return info;
  }

  void add_to_key(Hasher& key) const override {
    key.add("input", parameters_.input);
    key.add_value("bind", parameters_.bind);
    for (const RigFile& file : parameters_.files) {
      key.add("file", file.name);
      key.add_value("role", file.role);
      key.add_value("is_first", file.is_first);
    }
  }

  void run(const StageInput& in, StageOutput& out, IssueSink& issues) const override {
    InputContents contents;
    const Files files = sort_files(in, contents);
    Rigged rigged = read_rigged(files.rig, parameters_.bind, issues);
    expect_clips_in_limits(rigged.character);
    std::vector<PosedShape> examples;
    for (std::size_t i = 0; i < files.shapes.size(); ++i)
      examples.push_back({read_shape(files.shapes[i].front(), rigged), read_pose(files.poses[i], rigged)});
    rigged.character.name = parameters_.input;
    rigged.character.mesh = recover_quads(rigged.character.mesh);
    contents.joints = rigged.character.skeleton.names();
    for (const Clip& clip : rigged.character.clips) contents.clips.push_back(clip.name);
    out.put(names_.imported(parameters_.input), std::move(rigged.character));
    out.put(names_.contents(parameters_.input), std::move(contents));
    out.put(names_.examples(parameters_.input), std::move(examples));
  }

 private:
  struct Files {
    RigFiles rig;
    std::vector<std::vector<InputFile>> shapes;  ///< of examples; each with the files it names
    std::vector<InputFile> poses;                ///< of examples
  };
  Files sort_files(const StageInput& in, InputContents& contents) const {
    Files files;
    for (std::size_t i = 0; i < parameters_.files.size(); ++i) {
      const RigFile& entry = parameters_.files[i];
      const std::string artifact = names_.file(parameters_.input, i);
      InputFile file{entry.name, in.get<Bytes>(artifact), in.digest(artifact)};
      contents.files.push_back({file.path, file.digest, file.bytes.size()});
      list_of(entry, files).push_back(std::move(file));
    }
    return files;
  }
  static std::vector<InputFile>& list_of(const RigFile& entry, Files& files) {
    switch (entry.role) {
      case RigRole::Skeleton:
        return files.rig.skeleton;
      case RigRole::HandleFile:
        return files.rig.handles;
      case RigRole::Clips:
        if (entry.is_first) files.rig.clips.emplace_back();
        return files.rig.clips.back();
      case RigRole::ExampleShape:
        if (entry.is_first) files.shapes.emplace_back();
        return files.shapes.back();
      case RigRole::ExamplePose:
        return files.poses;
      case RigRole::Model:
        break;
    }
    return files.rig.model;
  }

  ArtifactNames names_;
  RigParameters parameters_;
};

}  // namespace

StagePointer make_rig_stage(const ArtifactNames& names, RigParameters parameters) {
  return std::make_unique<Rig>(names, std::move(parameters));
}

}  // namespace skinforge
