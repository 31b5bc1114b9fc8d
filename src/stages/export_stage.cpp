#include <nlohmann/json.hpp>

#include "base/version.h"
#include "io/glb_stamp.h"
#include "stages/corrective_bake.h"
#include "stages/inputs.h"
#include "stages/stages.h"

namespace skinforge {
namespace {

// Morph weights name parts of the driving input; the result has that part once for each use of the input.
std::vector<MorphTracks> morphs_on_result(const std::vector<MorphTracks>& morphs, std::size_t input,
                                          const Graft& graft, const JoinedSurface& joined) {
  std::vector<MorphTracks> carried;
  for (std::size_t s = 0; s < graft.sources.size(); ++s) {
    if (graft.sources[s].input != input) continue;
    for (MorphTracks tracks : morphs) {
      tracks.part = PartId(tracks.part.value + joined.first_part[s].value);
      carried.push_back(std::move(tracks));
    }
  }
  return carried;
}

Bytes as_bytes(const std::string& text) {
  const auto* begin = reinterpret_cast<const std::byte*>(text.data());
  return {begin, begin + text.size()};
}

/// The finished character and its files.
class Export final : public Stage {
 public:
  Export(ArtifactNames names, const Recipe& recipe, std::span<const ClipRequest> clips)
      : names_(std::move(names)),
        inputs_(input_names(recipe)),
        recipe_digest_(recipe_digest(recipe)),
        clips_(clips.begin(), clips.end()) {
    options_.max_influences = static_cast<std::size_t>(recipe.output.influences);
    wants_obj_ = !recipe.output.obj.empty();
    is_corrected_ = recipe.correctives.method != RecipeDeform::None;
  }

  StageInfo info() const override {
    StageInfo info{.name = "export",
                   .version = 3,
                   .reads = joined(contents_names(names_, inputs_),
                                   {names_.textured(), names_.graft(), names_.surface()}),
                   .writes = {names_.result(), names_.glb(), names_.obj()}};
    for (const ClipRequest& clip : clips_) info.reads.push_back(names_.clip(clip.name));
    if (is_corrected_) {
      info.reads.push_back(names_.correctives());
      info.writes.push_back(names_.driver());
    }
    return info;
  }
  void add_to_key(Hasher& key) const override {
    key.add("recipe", recipe_digest_);
    key.add_value("influences", options_.max_influences);
    key.add_value("obj", wants_obj_);
  }

  void run(const StageInput& in, StageOutput& out, IssueSink&) const override {
    Character result = in.get<Character>(names_.textured());
    const auto& graft = in.get<Graft>(names_.graft());
    const auto& surface = in.get<SurfaceResult>(names_.surface()).joined;
    for (const ClipRequest& request : clips_) {
      Clip clip = in.get<CompletedClip>(names_.clip(request.name)).clip;
      clip.morphs = morphs_on_result(clip.morphs, request.input, graft, surface);
      result.clips.push_back(std::move(clip));
    }
    if (is_corrected_) {
      const auto& correctives = in.get<BakedCorrectives>(names_.correctives());
      add_correctives(result, correctives);
      out.put(names_.driver(), as_bytes(correctives.driver_json));
    }
    validate(result);
    GlbOptions options = options_;
    options.extras_json = provenance(in);
    out.put(names_.glb(), stamped(write_glb(result, options)));
    out.put(names_.obj(), as_bytes(wants_obj_ ? write_obj(result) : std::string()));
    out.put(names_.result(), std::move(result));
  }

 private:
  // What the file was made of: names and digests, no paths, dates or hosts.
  std::string provenance(const StageInput& in) const {
    nlohmann::json inputs = nlohmann::json::object();
    for (const std::string& input : inputs_)
      for (const SourceFile& file : in.get<InputContents>(names_.contents(input)).files)
        inputs[input].push_back({{"file", file.name}, {"sha256", file.digest.hex()}});
    const nlohmann::json extras = {{"version", kVersion},
                                   {"recipe_sha256", recipe_digest_.hex()},
                                   {"inputs", std::move(inputs)},
                                   {kStampKey, unset_stamp()}};
    return extras.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  }

  ArtifactNames names_;
  std::vector<std::string> inputs_;
  Digest recipe_digest_;
  std::vector<ClipRequest> clips_;
  GlbOptions options_;
  bool wants_obj_ = false;
  bool is_corrected_ = false;
};

}  // namespace

StagePointer make_export_stage(const ArtifactNames& names, const Recipe& recipe,
                               std::span<const ClipRequest> clips) {
  return std::make_unique<Export>(names, recipe, clips);
}

}  // namespace skinforge
