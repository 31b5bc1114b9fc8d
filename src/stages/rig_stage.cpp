#include "deform/posed_bones.h"
#include "geometry/quad_pairing.h"
#include "stages/rigging.h"
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
                   .version = 1,
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
    }
  }

  void run(const StageInput& in, StageOutput& out, IssueSink& issues) const override {
    RigFiles files;
    std::vector<InputFile> shapes, poses;
    InputContents contents;
    for (std::size_t i = 0; i < parameters_.files.size(); ++i) {
      const std::string artifact = names_.file(parameters_.input, i);
      InputFile file{parameters_.files[i].name, in.get<Bytes>(artifact), in.digest(artifact)};
      contents.files.push_back({file.path, file.digest, file.bytes.size()});
      switch (parameters_.files[i].role) {
        case RigRole::Model:
          files.model.push_back(std::move(file));
          break;
        case RigRole::Skeleton:
          files.skeleton.push_back(std::move(file));
          break;
        case RigRole::Labels:
          files.handles = std::move(file);
          break;
        case RigRole::Poses:
          files.poses.push_back(std::move(file));
          break;
        case RigRole::ExampleShape:
          shapes.push_back(std::move(file));
          break;
        case RigRole::ExamplePose:
          poses.push_back(std::move(file));
          break;
      }
    }
    Rigged rigged = read_rigged(files, parameters_.bind, issues);
    std::vector<PosedShape> examples;
    for (std::size_t i = 0; i < shapes.size(); ++i)
      examples.push_back({read_shape(shapes[i], rigged), read_pose(poses[i], rigged)});
    rigged.character.name = parameters_.input;
    rigged.character.mesh = recover_quads(rigged.character.mesh);
    contents.joints = rigged.character.skeleton.names();
    for (const Clip& clip : rigged.character.clips) contents.clips.push_back(clip.name);
    out.put(names_.imported(parameters_.input), std::move(rigged.character));
    out.put(names_.contents(parameters_.input), std::move(contents));
    out.put(names_.examples(parameters_.input), std::move(examples));
  }

 private:
  ArtifactNames names_;
  RigParameters parameters_;
};

}  // namespace

StagePointer make_rig_stage(const ArtifactNames& names, RigParameters parameters) {
  return std::make_unique<Rig>(names, std::move(parameters));
}

}  // namespace skinforge
