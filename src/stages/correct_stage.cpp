#include "base/expect.h"
#include "stages/corrective_bake.h"
#include "stages/inputs.h"
#include "stages/stages.h"

namespace skinforge {
namespace {

DeformMethod method_of(RecipeDeform method) {
  if (method == RecipeDeform::Poisson) return DeformMethod::Poisson;
  return method == RecipeDeform::Context ? DeformMethod::Context : DeformMethod::DualQuaternion;
}

/// Morph targets that bring linear blending to what a better method gives.
class Correct final : public Stage {
 public:
  Correct(ArtifactNames names, const Recipe& recipe, std::span<const ClipRequest> clips)
      : names_(std::move(names)),
        base_(recipe.base),
        options_(recipe.correctives),
        clips_(clips.begin(), clips.end()) {
    influences_ = static_cast<std::size_t>(recipe.output.influences);
  }

  StageInfo info() const override {
    StageInfo info{
        .name = "correct", .version = 2, .reads = {names_.textured()}, .writes = {names_.correctives()}};
    for (const ClipRequest& clip : clips_) info.reads.push_back(names_.clip(clip.name));
    if (options_.method == RecipeDeform::Context) {
      info.reads.push_back(names_.examples(base_));
      info.reads.push_back(names_.character(base_));
      info.reads.push_back(names_.surface());
    }
    return info;
  }
  void add_to_key(Hasher& key) const override {
    key.add_value("options", options_);
    key.add_value("influences", static_cast<std::uint64_t>(influences_));
  }

  void run(const StageInput& in, StageOutput& out, IssueSink& issues) const override {
    Character character = in.get<Character>(names_.textured());
    for (const ClipRequest& clip : clips_)
      character.clips.push_back(in.get<CompletedClip>(names_.clip(clip.name)).clip);
    BakeRequest request{.method = method_of(options_.method),
                        .targets = static_cast<std::size_t>(options_.targets),
                        .enough = options_.enough,
                        .influences = influences_};
    if (options_.method == RecipeDeform::Context) {
      SF_EXPECT(character.skeleton.names() == in.get<Character>(names_.character(base_)).skeleton.names());
      request.examples = in.get<std::vector<PosedShape>>(names_.examples(base_));
      for (PosedShape& example : request.examples)
        example.shape = by_result(example.shape, in.get<SurfaceResult>(names_.surface()));
      request.with_rest = options_.rest;
      request.kernel =
          options_.kernel == RecipeKernel::Gaussian ? RadialKernel::Gaussian : RadialKernel::Linear;
      request.joints = options_.joints;
    }
    out.put(names_.correctives(), bake_character(character, request, "result", issues));
  }

 private:
  // Examples count vertices as the base does, the result as its faces name them.
  static std::vector<Vec3> by_result(const std::vector<Vec3>& shape, const SurfaceResult& surface) {
    std::vector<Vec3> ordered;
    for (const ResultVertex& v : surface.joined.vertices) ordered.push_back(shape[v.vertex.index()]);
    return ordered;
  }

  ArtifactNames names_;
  std::string base_;
  CorrectivesOptions options_;
  std::vector<ClipRequest> clips_;
  std::size_t influences_ = 4;
};

}  // namespace

StagePointer make_correct_stage(const ArtifactNames& names, const Recipe& recipe,
                                std::span<const ClipRequest> clips) {
  return std::make_unique<Correct>(names, recipe, clips);
}

}  // namespace skinforge
