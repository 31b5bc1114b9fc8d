#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/version.h"
#include "report/measures.h"
#include "report/report_json.h"
#include "skinning/weight_rows.h"
#include "stages/inputs.h"
#include "stages/material_merge.h"
#include "stages/placed_sources.h"
#include "stages/stages.h"
#include "surface/assemble.h"

namespace skinforge {
namespace {

constexpr double kStays = 0.5;  // as the reference's preview: mean presence of a face that is shown

// Faces that a preview shows: the part of each source up to the middle of its cut.
FaceSet shown_faces(const PolygonMesh& mesh, const SourceSelection& selection) {
  FaceSet shown;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    double sum = 0;
    for (const VertexId v : mesh.face(FaceId(f))) sum += selection.presence[v.index()];
    const bool is_present = sum >= kStays * static_cast<double>(mesh.face(FaceId(f)).size());
    const ComponentRole role = selection.face_role[f];
    const bool is_cut = role == ComponentRole::Blended || role == ComponentRole::Sheet;
    shown.push_back(role == ComponentRole::KeptWhole || (is_cut && is_present));
  }
  return shown;
}

/// The parts cut, placed, skinned and animated together, without anything that takes time: open where they
/// meet, and the other parts hold still in each clip. For trying placements.
class Preview final : public Stage {
 public:
  Preview(ArtifactNames names, const Recipe& recipe, std::span<const ClipRequest> clips)
      : names_(std::move(names)),
        inputs_(input_names(recipe)),
        name_(recipe.name),
        recipe_digest_(recipe_digest(recipe)),
        clips_(clips.begin(), clips.end()),
        influences_(static_cast<std::size_t>(recipe.output.influences)),
        glb_(preview_name(recipe)) {
    for (const RecipeOperation& operation : recipe.operations) {
      options_.push_back(cut_options(operation.surface));
      options_.back().at.smoothing_passes = options_.back().from.smoothing_passes = 0;
    }
  }

  StageInfo info() const override {
    return {.name = "preview",
            .version = 2,
            .reads = joined(character_names(names_, inputs_),
                            {names_.placement(), names_.graft(), names_.joint_maps()}),
            .writes = {names_.preview_glb(), names_.preview_report()}};
  }
  void add_to_key(Hasher& key) const override {
    key.add("recipe", recipe_digest_);
    key.add_value("inputs", inputs_);
    key.add("glb", glb_);
    for (const ClipRequest& clip : clips_) {
      key.add("clip", clip.name);
      key.add_value("input", clip.input);
      key.add_value("index", clip.clip);
    }
  }

  void run(const StageInput& in, StageOutput& out, IssueSink& issues) const override {
    const auto characters = get_characters(in, names_, inputs_);
    const auto& graft = in.get<Graft>(names_.graft());
    const JoinedSurface surface =
        joined_parts(characters, graft, in.get<PlacedOperations>(names_.placement()), issues);
    Character result;
    result.name = name_;
    result.skeleton = graft.skeleton;
    result.mesh = surface.mesh;
    result.weights =
        weights_of(characters, graft, surface, in.get<std::vector<JointMap>>(names_.joint_maps()));
    std::vector<std::int32_t> input_of_face;
    for (const ResultFace& face : surface.faces)
      input_of_face.push_back(static_cast<std::int32_t>(graft.sources[face.source.index()].input));
    merge_materials(result, characters, inputs_, input_of_face);
    Report report;
    add_clips(characters, graft, result, report);
    validate(result);
    GlbOptions options{.max_influences = influences_, .encode_polygons = true, .extras_json = ""};
    options.extras_json =
        nlohmann::json({{"version", kVersion}, {"recipe_sha256", recipe_digest_.hex()}, {"preview", true}})
            .dump();
    Bytes glb = write_glb(result, options);
    issues.note("preview-only", "result",
                "a preview: parts are not joined, other parts hold still in each clip, morphs and junction "
                "colours are left out");
    fill(report, result, glb, issues);
    const std::string text = to_json(report);
    const auto* begin = reinterpret_cast<const std::byte*>(text.data());
    out.put(names_.preview_report(), Bytes(begin, begin + text.size()));
    out.put(names_.preview_glb(), std::move(glb));
  }

 private:
  JoinedSurface joined_parts(const std::vector<const Character*>& characters, const Graft& graft,
                             const PlacedOperations& placement, IssueSink& issues) const {
    std::vector<PolygonMesh> placed;
    for (std::size_t s = 0; s < graft.sources.size(); ++s)
      placed.push_back(place_mesh(*characters[graft.sources[s].input], graft, SourceId(s), placement));
    std::vector<PreservedSource> sources;
    for (std::size_t s = 0; s < graft.sources.size(); ++s) {
      const std::size_t input = graft.sources[s].input;
      const std::vector<Cut> cuts = cuts_of_source(graft, characters[input]->skeleton, SourceId(s), options_);
      sources.push_back({&placed[s], select_faces(placed[s], characters[input]->weights, cuts,
                                                  fmt::format("input {}", inputs_[input]), issues)});
      sources.back().selection.kept = shown_faces(placed[s], sources.back().selection);
    }
    return assemble_surface(sources, std::vector<Junction>(graft.sites.size()));
  }

  static SkinWeights weights_of(const std::vector<const Character*>& characters, const Graft& graft,
                                const JoinedSurface& surface, const std::vector<JointMap>& maps) {
    SkinWeights weights;
    for (const ResultVertex& v : surface.vertices) {
      const SkinWeights& of_input = characters[graft.sources[v.source.index()].input]->weights;
      std::vector<Influence> row = retargeted_row(of_input.of(v.vertex), maps[v.source.index()]);
      if (row.empty()) row = {{JointId(0), 1}};
      weights.push_row(row);
    }
    return weights;
  }

  void add_clips(const std::vector<const Character*>& characters, const Graft& graft, Character& result,
                 Report& report) const {
    const MotionSet none;
    const std::vector<const MotionSet*> motions(graft.sources.size(), &none);
    for (const ClipRequest& request : clips_) {
      CompletionOptions alone;
      alone.complete = false;
      Clip clip =
          complete_clip(characters, graft, motions, request.input, request.clip, request.name, alone).clip;
      clip.morphs.clear();
      ClipReport r;
      r.name = request.name;
      r.input = inputs_[request.input];
      r.source_clip = characters[request.input]->clips[request.clip].name;
      r.duration = clip.duration;
      r.keys = count_keys(clip);
      r.driven_joints = static_cast<std::int64_t>(clip.joints.size());
      report.clips.push_back(std::move(r));
      result.clips.push_back(std::move(clip));
    }
  }

  void fill(Report& report, const Character& result, const Bytes& glb, const IssueSink& issues) const {
    report.tool.version = kVersion;
    report.preview = true;
    report.recipe = {name_, recipe_digest_.hex()};
    report.mesh = measure_mesh(result.mesh, static_cast<std::int64_t>(result.mesh.face_count()));
    report.weights = measure_weights(result.weights, result.skeleton, influences_);
    report.outputs.push_back({glb_, static_cast<std::int64_t>(glb.size()), sha256(glb).hex()});
    report.issues = issues.issues();
  }

  ArtifactNames names_;
  std::vector<std::string> inputs_;
  std::string name_;
  Digest recipe_digest_;
  std::vector<ClipRequest> clips_;
  std::size_t influences_;
  std::string glb_;
  std::vector<CutOptions> options_;  // per operation
};

}  // namespace

std::string preview_name(const Recipe& recipe) {
  const std::filesystem::path glb(recipe.output.glb.empty() ? recipe.name + ".glb" : recipe.output.glb);
  return (glb.parent_path() / (glb.stem().string() + "-preview.glb")).string();
}

StagePointer make_preview_stage(const ArtifactNames& names, const Recipe& recipe,
                                std::span<const ClipRequest> clips) {
  return std::make_unique<Preview>(names, recipe, clips);
}

}  // namespace skinforge
