#include <fmt/format.h>

#include "base/version.h"
#include "report/frame_runs.h"
#include "report/measures.h"
#include "report/report_json.h"
#include "stages/golden_comparison.h"
#include "stages/inputs.h"
#include "stages/junction_report.h"
#include "stages/origins.h"
#include "stages/stages.h"
#include "surface/junction_measures.h"

namespace skinforge {
namespace {

const char* name_of(GraftKind kind) {
  switch (kind) {
    case GraftKind::Replace:
      return "replace";
    case GraftKind::Attach:
      return "attach";
    case GraftKind::Remove:
      return "remove";
    case GraftKind::Detach:
      return "detach";
  }
  return "replace";
}

std::int64_t wide(std::size_t n) {
  return static_cast<std::int64_t>(n);
}

std::string file_format(const std::string& file) {
  const auto dot = file.rfind('.');
  return dot == std::string::npos ? "" : file.substr(dot + 1);
}

PosedReport report_posed(const ClipQuality& quality) {
  PosedReport r;
  r.frames = wide(quality.times.size());
  r.worst_time = quality.worst_time;
  r.intersections = static_cast<std::int64_t>(quality.intersections);
  r.folds = static_cast<std::int64_t>(quality.folds);
  r.stretch = quality.stretch;
  r.foot_sink = quality.foot_sink;
  r.foot_slide = quality.foot_slide;
  return r;
}

ClipReport report_clip(const CompletedClip& completed, const ClipQuality& quality, const std::string& input) {
  const CompletionRecord& record = completed.record;
  ClipReport r;
  r.name = record.clip;
  r.input = input;
  r.source_clip = record.source_clip;
  r.duration = record.duration;
  r.keys = count_keys(completed.clip);
  r.driven_joints = wide(completed.clip.joints.size());
  std::vector<ChosenFrame> frames;
  for (const CompletionRecord::Choice& c : record.choices)
    frames.push_back({c.source.value, c.time, c.clip, c.clip_time});
  r.completed_from = frame_runs(frames);
  for (const CompletionRecord::Turn& t : record.turns) r.turned_limbs.push_back({t.joint, degrees(t.angle)});
  if (!frames.empty()) r.mean_distance = record.mean_distance;
  r.jumps = record.jumps;
  r.playback = record.is_loop ? "loop" : "once";
  r.posed = report_posed(quality);
  r.fastest_turn = record.fastest_turn;
  r.fastest_joint = record.fastest_joint;
  r.fastest_source_turn = record.fastest_source_turn;
  if (record.fastest_source_turn > 0) r.turn_ratio = record.fastest_turn / record.fastest_source_turn;
  return r;
}

/// report.json: everything a person or a nightly run wants to know of the result.
class MakeReport final : public Stage {
 public:
  MakeReport(ArtifactNames names, const Recipe& recipe, std::span<const ClipRequest> clips,
             IssueArtifacts issues)
      : names_(std::move(names)),
        inputs_(input_names(recipe)),
        name_(recipe.name),
        recipe_digest_(recipe_digest(recipe).hex()),
        glb_(recipe.output.glb),
        obj_(recipe.output.obj),
        influences_(static_cast<std::size_t>(recipe.output.influences)),
        clips_(clips.begin(), clips.end()),
        site_count_(recipe.operations.size()),
        issues_(std::move(issues)) {
    if (recipe.golden) golden_ = recipe.golden->file.resolved.filename().string();
    for (const RecipeInput& input : recipe.inputs) files_.push_back(input.file.resolved.filename().string());
  }

  StageInfo info() const override {
    StageInfo info{.name = "report",
                   .version = 3,
                   .reads = joined(joined(character_names(names_, inputs_), contents_names(names_, inputs_)),
                                   {names_.placement(), names_.graft(), names_.joint_maps(), names_.surface(),
                                    names_.weight_record(), names_.color_steps(), names_.result(),
                                    names_.glb(), names_.obj(), names_.validation()}),
                   .writes = {names_.report()}};
    if (!golden_.empty()) info.reads.push_back(names_.comparison());
    for (std::size_t k = 0; k < site_count_; ++k) info.reads.push_back(names_.field(k));
    for (const ClipRequest& clip : clips_) {
      info.reads.push_back(names_.clip(clip.name));
      info.reads.push_back(names_.quality(clip.name));
    }
    for (const auto& of_input : issues_.of_input) info.reads = joined(std::move(info.reads), of_input);
    info.reads = joined(std::move(info.reads), issues_.of_build);
    return info;
  }

  void add_to_key(Hasher& key) const override {
    key.add("recipe", recipe_digest_);
    key.add("name", name_);
    key.add_value("files", files_);
    if (!golden_.empty()) key.add("golden", golden_);
  }

  void run(const StageInput& in, StageOutput& out, IssueSink&) const override {
    const auto characters = get_characters(in, names_, inputs_);
    const auto& graft = in.get<Graft>(names_.graft());
    const auto& surface = in.get<SurfaceResult>(names_.surface());
    const auto& result = in.get<Character>(names_.result());
    Report report;
    report.tool.version = kVersion;
    report.recipe = {name_, recipe_digest_};
    add_inputs(in, characters, report);
    add_operations(graft, in.get<PlacedOperations>(names_.placement()).turns, report);
    add_joints(in, characters, graft, report);
    const auto& color = in.get<std::vector<ColorSteps>>(names_.color_steps());
    for (std::size_t k = 0; k < site_count_; ++k)
      report.junctions.push_back(report_junction(surface, k, in.get<SiteField>(names_.field(k)), color[k]));
    add_mesh(surface, result, influences_, report);
    set_steps(in.get<WeightRecord>(names_.weight_record()), report.weights);
    for (const ClipRequest& clip : clips_)
      report.clips.push_back(report_clip(in.get<CompletedClip>(names_.clip(clip.name)),
                                         in.get<ClipQuality>(names_.quality(clip.name)),
                                         inputs_[clip.input]));
    std::vector<LedgerInput> ledger_inputs;
    for (std::size_t i = 0; i < inputs_.size(); ++i) ledger_inputs.push_back({inputs_[i], characters[i]});
    report.ledger = build_ledger(ledger_inputs, result,
                                 result_origins(characters, inputs_, graft, surface.joined, result, clips_));
    add_output(in, names_.glb(), glb_, report);
    add_output(in, names_.obj(), obj_, report);
    if (!golden_.empty()) report.golden = golden_report(in.get<GoldenComparison>(names_.comparison()));
    report.issues = issues_in(in, issues_.of_build);
    const std::string text = to_json(report);
    const auto* begin = reinterpret_cast<const std::byte*>(text.data());
    out.put(names_.report(), Bytes(begin, begin + text.size()));
  }

 private:
  static std::vector<Issue> issues_in(const StageInput& in, const std::vector<std::string>& artifacts) {
    std::vector<Issue> all;
    for (const std::string& artifact : artifacts) {
      const auto& issues = in.get<std::vector<Issue>>(artifact);
      all.insert(all.end(), issues.begin(), issues.end());
    }
    return all;
  }

  static void set_steps(const WeightRecord& record, WeightsReport& report) {
    report.junction_step = record.steps.junction;
    report.junction_step_blended = record.blended.junction;
    report.neighbour_step = record.steps.neighbours;
    report.filled_vertices = static_cast<std::int64_t>(record.filled_rows);
  }

  void add_inputs(const StageInput& in, const std::vector<const Character*>& characters,
                  Report& report) const {
    for (std::size_t i = 0; i < inputs_.size(); ++i) {
      InputReport input = measure_input(*characters[i]);
      input.name = inputs_[i];
      input.file = files_[i];
      input.format = file_format(files_[i]);
      for (const SourceFile& file : in.get<InputContents>(names_.contents(inputs_[i])).files)
        input.files.push_back({file.name, static_cast<std::int64_t>(file.bytes), file.digest.hex()});
      input.repairs = issues_in(in, issues_.of_input[i]);
      report.inputs.push_back(std::move(input));
    }
  }

  GoldenReport golden_report(const GoldenComparison& comparison) const {
    GoldenReport report{golden_, comparison.is_missing, {}};
    for (const DiffFinding& f : comparison.findings)
      report.findings.push_back({f.group, f.name, f.text, f.is_over});
    return report;
  }

  void add_operations(const Graft& graft, const std::vector<PartTurn>& turns, Report& report) const {
    for (std::size_t k = 0; k < graft.sites.size(); ++k) {
      const GraftSite& site = graft.sites[k];
      OperationReport r;
      r.bend_deg = degrees(turns[k].bend);
      r.turned_deg = degrees(turns[k].angle);
      r.kind = name_of(site.kind);
      for (const auto& [source, joint] : site.at) r.at.push_back(joint_name(graft, source, joint));
      if (site.donor.is_valid()) {
        r.input = inputs_[graft.sources[site.donor.index()].input];
        r.joint = r.fused_joint = graft.skeleton[site.fused].name;
        set_placement(r, graft.sources[site.donor.index()].model_from_input);
      }
      report.operations.push_back(std::move(r));
    }
  }

  // Name of an input joint; joints that left are no longer in the result, so the origin table cannot tell.
  std::string joint_name(const Graft& graft, SourceId source, JointId joint) const {
    return fmt::format("{}:{}", inputs_[graft.sources[source.index()].input], joint.value);
  }

  void add_joints(const StageInput& in, const std::vector<const Character*>& characters, const Graft& graft,
                  Report& report) const {
    const auto& maps = in.get<std::vector<JointMap>>(names_.joint_maps());
    for (std::size_t s = 0; s < maps.size(); ++s) {
      const std::size_t input = graft.sources[s].input;
      JointMapReport map{wide(s), inputs_[input], {}};
      for (std::size_t j = 0; j < maps[s].size(); ++j)
        map.joints.push_back({characters[input]->skeleton.joints[j].name,
                              graft.skeleton[maps[s][j].image].name, maps[s][j].confidence});
      report.joint_maps.push_back(std::move(map));
    }
    for (std::size_t j = 0; j < graft.skeleton.size(); ++j) {
      const JointOrigin& origin = graft.origins[j];
      const std::size_t input = graft.sources[origin.source.index()].input;
      report.joints.push_back({graft.skeleton.joints[j].name, origin.source.value, inputs_[input],
                               characters[input]->skeleton[origin.joint].name});
    }
    for (std::size_t k = 0; k < graft.sites.size(); ++k)
      for (std::size_t a = 0; a < graft.sites[k].at.size(); ++a) {
        const auto& [source, joint] = graft.sites[k].at[a];
        report.operations[k].at[a] = characters[graft.sources[source.index()].input]->skeleton[joint].name;
      }
  }

  static void add_mesh(const SurfaceResult& surface, const Character& result, std::size_t influences,
                       Report& report) {
    std::int64_t kept = 0;
    for (const ResultFace& face : surface.joined.faces) kept += face.source.is_valid();
    report.mesh = measure_mesh(result.mesh, kept);
    const InheritedEdges inherited = inherited_edges(surface.joined);
    report.mesh.open_edges_inherited = wide(inherited.open);
    report.mesh.non_manifold_edges_inherited = wide(inherited.non_manifold);
    report.mesh.components = connected_components(result.mesh).count;
    report.weights = measure_weights(result.weights, result.skeleton, influences);
  }

  static void add_output(const StageInput& in, const std::string& artifact, const std::string& name,
                         Report& report) {
    if (!name.empty())
      report.outputs.push_back({name, wide(in.get<Bytes>(artifact).size()), in.digest(artifact).hex()});
  }

  ArtifactNames names_;
  std::vector<std::string> inputs_, files_;
  std::string name_, recipe_digest_, glb_, obj_;
  std::string golden_;  // file name; empty without one
  std::size_t influences_;
  std::vector<ClipRequest> clips_;
  std::size_t site_count_;
  IssueArtifacts issues_;
};

}  // namespace

StagePointer make_report_stage(const ArtifactNames& names, const Recipe& recipe,
                               std::span<const ClipRequest> clips, IssueArtifacts issues) {
  return std::make_unique<MakeReport>(names, recipe, clips, std::move(issues));
}

}  // namespace skinforge
