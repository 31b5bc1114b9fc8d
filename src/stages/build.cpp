#include "stages/build.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/hash.h"
#include "base/limits.h"
#include "base/text.h"
#include "io/import.h"
#include "stages/expect_stage.h"
#include "stages/inputs.h"
#include "stages/pictures.h"

namespace skinforge {
namespace {

ArtifactNames nested_names(const ArtifactNames& names, const std::string& input) {
  return {names.prefix + input + "/"};
}

// Puts the files behind one path into the engine and returns their names, the first file first.
std::vector<std::string> add_files(Engine& engine, const ArtifactNames& names, const std::string& input,
                                   const RecipePath& path, std::size_t& next) {
  std::vector<std::string> file_names;
  for (InputFile& file : read_input_files(path.resolved.string(), &engine.digests())) {
    file_names.push_back(file_names.empty() ? path.resolved.filename().string()
                                            : std::filesystem::path(file.path).filename().string());
    auto bytes = std::make_shared<const Bytes>(std::move(file.bytes));
    engine.put_source(names.file(input, next++), file.digest, bytes->size(), [bytes] { return *bytes; });
  }
  return file_names;
}

void add_file_import(const Recipe& recipe, std::size_t i, Engine& engine, const ArtifactNames& names) {
  const RecipeInput& input = recipe.inputs[i];
  ImportParameters parameters{input.name, {}};
  std::size_t next = 0;
  with_context(recipe.place("/inputs/" + input.name), [&] {
    parameters.file_names.push_back(add_files(engine, names, input.name, input.file, next));
    for (const RecipePath& clips : input.clips)
      parameters.file_names.push_back(add_files(engine, names, input.name, clips, next));
  });
  engine.add(make_import_stage(names, std::move(parameters)));
}

// An input whose skin is made here. Examples of correctives go by the vertices of the base's file.
void add_rigged_import(const Recipe& recipe, std::size_t i, Engine& engine, const ArtifactNames& names) {
  const RecipeInput& input = recipe.inputs[i];
  RigParameters parameters{input.name, *input.bind, {}};
  std::size_t next = 0;
  const auto add = [&](const RecipePath& path, RigRole role) {
    bool is_first = true;
    for (const std::string& file : add_files(engine, names, input.name, path, next)) {
      parameters.files.push_back({file, role, is_first});
      is_first = false;
    }
  };
  with_context(recipe.place("/inputs/" + input.name), [&] {
    add(input.file, RigRole::Model);
    if (!input.bind->skeleton.text.empty()) add(input.bind->skeleton, RigRole::Skeleton);
    if (!input.bind->handle_file.text.empty()) add(input.bind->handle_file, RigRole::HandleFile);
    for (const RecipePath& clips : input.clips) add(clips, RigRole::Clips);
  });
  if (input.name == recipe.base)
    with_context(recipe.place("/correctives/examples"), [&] {
      for (const RecipeExample& example : recipe.correctives.examples) {
        add(example.shape, RigRole::ExampleShape);
        add(example.pose, RigRole::ExamplePose);
      }
    });
  engine.add(make_rig_stage(names, std::move(parameters)));
}

// A recipe used as an input: its own stages, then one that takes its result.
bool add_recipe_import(const RecipeInput& input, Engine& engine, const Settle& settle,
                       const ArtifactNames& names) {
  const ArtifactNames nested = nested_names(names, input.name);
  if (!add_imports(*input.recipe, engine, settle, nested)) return false;
  settle();
  if (!knows_contents(*input.recipe, engine, nested)) return false;
  add_grafts(*input.recipe, engine, ReportLevel::None, nested);
  engine.add(make_adopt_stage(names, nested, input));
  return true;
}

// All clips that the inputs bring.
class ClipCatalog {
 public:
  ClipCatalog(const Recipe& recipe, Engine& engine, const ArtifactNames& names) : recipe_(recipe) {
    for (const RecipeInput& input : recipe.inputs)
      clips_.push_back(engine.get<InputContents>(names.contents(input.name)).clips);
    add_requests();
  }

  // Every clip, the base's first. A clip keeps its name; where two inputs bring the same, the later one
  // becomes <input>_<name>.
  const std::vector<ClipRequest>& all() const { return all_; }
  bool is_called(const ClipRequest& request, const std::string& name) const {
    return request.name == name || clips_[request.input][request.clip] == name;
  }
  // Throws when no clip has this name; `inputs_but`: a clip of this input does not count.
  void require(const std::string& name, const std::string& pointer, std::size_t inputs_but) const {
    std::vector<std::string> known;
    for (const ClipRequest& request : all_) {
      if (request.input == inputs_but) continue;
      if (is_called(request, name)) return;
      known.push_back(request.name);
    }
    throw Error(ExitCode::Usage,
                fmt::format("{}: no clip \"{}\" in any {}input{}", recipe_.place(pointer), printable(name),
                            inputs_but < clips_.size() ? "other " : "", nearest_hint(name, known)));
  }

 private:
  void add_requests() {
    std::vector<std::size_t> order{recipe_.input_index(recipe_.base)};
    for (std::size_t i = 0; i < clips_.size(); ++i)
      if (i != order.front()) order.push_back(i);
    std::set<std::string> taken;
    for (const std::size_t i : order)
      for (std::size_t c = 0; c < clips_[i].size(); ++c) {
        std::string name = clips_[i][c];
        if (taken.contains(name)) name = fmt::format("{}_{}", recipe_.inputs[i].name, clips_[i][c]);
        for (int n = 2; !taken.insert(name).second; ++n)
          name = fmt::format("{}_{}_{}", recipe_.inputs[i].name, clips_[i][c], n);
        all_.push_back({i, c, name});
      }
  }

  const Recipe& recipe_;
  std::vector<std::vector<std::string>> clips_;  // names, per input
  std::vector<ClipRequest> all_;
};

constexpr std::size_t kNoInput = static_cast<std::size_t>(-1);

std::string pointer_to_setting(const std::string& clip, const char* key) {
  return "/animation/per_clip/" + clip + "/" + key;
}

// Per input, the clips that one clip may be completed with.
std::vector<ClipChoice> clip_choices(const ClipCatalog& catalog, const ClipRequest& request,
                                     const std::string& name, const ClipSettings& settings,
                                     std::size_t inputs) {
  std::vector<ClipChoice> choices(inputs);
  for (const std::string& use : settings.use)
    catalog.require(use, pointer_to_setting(name, "use"), request.input);
  if (!settings.with.empty()) catalog.require(settings.with, pointer_to_setting(name, "with"), request.input);
  for (const ClipRequest& other : catalog.all()) {
    if (other.input == request.input) continue;
    ClipChoice& choice = choices[other.input];
    for (const std::string& use : settings.use)
      if (catalog.is_called(other, use)) choice.use.push_back(other.clip);
    if (!settings.with.empty() && !choice.with && catalog.is_called(other, settings.with))
      choice.with = other.clip;
  }
  return choices;
}

CompletionOptions completion_options(const AnimationOptions& animation, const ClipSettings& settings) {
  CompletionOptions options;
  const bool is_paper = settings.method.value_or(animation.method) == CompletionMethod::Paper;
  options.complete = settings.complete.value_or(animation.complete);
  options.choice = is_paper ? KeyframeChoice::Frame : KeyframeChoice::Sequence;
  options.key_rate_hz = settings.rate_hz ? settings.rate_hz : animation.rate_hz;
  options.tempo = settings.tempo.value_or(animation.tempo);
  options.loop = settings.loop;
  options.limb_phase = settings.limb_phase ? settings.limb_phase : animation.limb_phase;
  options.clearing = radians(settings.limb_clearing_deg.value_or(animation.limb_clearing_deg));
  options.key_tolerance = animation.key_tolerance;
  return options;
}

// The name in the result counts before that in the input.
std::string name_in_settings(const ClipCatalog& catalog, const AnimationOptions& animation,
                             const ClipRequest& request) {
  if (animation.per_clip.contains(request.name)) return request.name;
  for (const auto& [name, settings] : animation.per_clip)
    if (catalog.is_called(request, name)) return name;
  return "";
}

// The clips that the recipe wants, with their settings.
std::vector<ClipRequest> clip_requests(const Recipe& recipe, Engine& engine, const ArtifactNames& names) {
  const ClipCatalog catalog(recipe, engine, names);
  const AnimationOptions& animation = recipe.animation;
  for (const std::string& wanted : animation.clips) catalog.require(wanted, "/animation/clips", kNoInput);
  for (const auto& [name, settings] : animation.per_clip)
    catalog.require(name, "/animation/per_clip/" + name, kNoInput);
  for (const std::string& name : recipe.output.animated) catalog.require(name, "/output/animated", kNoInput);
  std::vector<ClipRequest> requests;
  for (ClipRequest request : catalog.all()) {
    const auto is_it = [&](const std::string& wanted) { return catalog.is_called(request, wanted); };
    if (!animation.all_clips && std::none_of(animation.clips.begin(), animation.clips.end(), is_it)) continue;
    const std::string name = name_in_settings(catalog, animation, request);
    const ClipSettings settings = name.empty() ? ClipSettings() : animation.per_clip.at(name);
    request.options = completion_options(animation, settings);
    if (!settings.use.empty() || !settings.with.empty())
      request.options.clips = clip_choices(catalog, request, name, settings, recipe.inputs.size());
    const auto& animated = recipe.output.animated;
    request.is_animated = recipe.output.all_animated || std::any_of(animated.begin(), animated.end(), is_it);
    requests.push_back(std::move(request));
  }
  return requests;
}

// Input of each source, as graft_skeletons numbers them: the base, then one for each operation that brings a
// part.
std::vector<std::string> inputs_of_sources(const Recipe& recipe) {
  std::vector<std::string> inputs{recipe.base};
  for (const RecipeOperation& operation : recipe.operations)
    if (!operation.from.empty()) inputs.push_back(operation.from);
  return inputs;
}

// Issues of all stages so far. Those of an import, or of the recipe behind an input, belong to that input.
IssueArtifacts issue_artifacts(const Recipe& recipe, const Engine& engine, const ArtifactNames& names) {
  IssueArtifacts found;
  found.of_input.resize(recipe.inputs.size());
  for (const StageInfo& stage : engine.stages()) {
    const std::string& first = stage.writes.front();
    const auto owner = std::find_if(recipe.inputs.begin(), recipe.inputs.end(), [&](const RecipeInput& i) {
      return first == names.imported(i.name) || first.starts_with(nested_names(names, i.name).prefix);
    });
    auto& list = owner == recipe.inputs.end()
                     ? found.of_build
                     : found.of_input[static_cast<std::size_t>(owner - recipe.inputs.begin())];
    list.push_back(issues_artifact(first));
  }
  return found;
}

std::string file_name_of_picture(const std::string& name) {
  return "pictures/" + name + ".png";
}

// A golden that is not there yet is a source without bytes: what is made of it has another key once it is.
void add_golden(const Recipe& recipe, Engine& engine, const ArtifactNames& names) {
  const std::string path = recipe.golden->file.resolved.string();
  with_context(recipe.place("/expect/golden"), [&] {
    InputFile file{path, {}, sha256(std::span<const std::byte>())};
    if (std::filesystem::exists(path)) file = read_input_file(path, limits().file, &engine.digests());
    auto bytes = std::make_shared<const Bytes>(std::move(file.bytes));
    engine.put_source(names.golden(), file.digest, bytes->size(), [bytes] { return *bytes; });
  });
  engine.add(make_compare_stage(names, *recipe.golden));
}

// What tells of the result. Called when all stages that the report reads are there.
void add_report(const Recipe& recipe, const std::vector<ClipRequest>& clips, std::size_t source_count,
                ReportLevel level, Engine& engine, const ArtifactNames& names) {
  for (const ClipRequest& clip : clips) {
    engine.add(make_quality_stage(names, source_count, clip));
    if (clip.is_animated) engine.add(make_animated_stage(names, clip));
  }
  engine.add(make_report_stage(names, recipe, clips, issue_artifacts(recipe, engine, names)));
  if (level != ReportLevel::Full) return;
  engine.add(make_pictures_stage(names, recipe, clips));
  engine.add(make_view_stage(names, recipe));
}
}  // namespace

bool add_imports(const Recipe& recipe, Engine& engine, const Settle& settle, const ArtifactNames& names) {
  bool is_complete = true;
  for (std::size_t i = 0; i < recipe.inputs.size(); ++i) {
    const RecipeInput& input = recipe.inputs[i];
    bool is_added = true;
    if (input.recipe)
      is_added = add_recipe_import(input, engine, settle, names);
    else if (input.bind)
      add_rigged_import(recipe, i, engine, names);
    else
      add_file_import(recipe, i, engine, names);
    if (is_added) engine.add(make_pose_stage(names, input));
    is_complete = is_complete && is_added;
  }
  return is_complete;
}

bool knows_contents(const Recipe& recipe, const Engine& engine, const ArtifactNames& names) {
  return std::all_of(recipe.inputs.begin(), recipe.inputs.end(),
                     [&](const RecipeInput& input) { return engine.has(names.contents(input.name)); });
}

void add_grafts(const Recipe& recipe, Engine& engine, ReportLevel level, const ArtifactNames& names) {
  const std::vector<ClipRequest> clips = clip_requests(recipe, engine, names);
  const std::vector<std::string> sources = inputs_of_sources(recipe);
  engine.add(make_place_stage(names, recipe));
  engine.add(make_turn_stage(names, recipe));
  engine.add(make_graft_skeleton_stage(names, recipe));
  engine.add(make_map_joints_stage(names, recipe));
  engine.add(make_select_stage(names, recipe));
  for (std::size_t k = 0; k < recipe.operations.size(); ++k) engine.add(make_field_stage(names, recipe, k));
  for (std::size_t k = 0; k < recipe.operations.size() && !recipe.output.vdb.empty(); ++k)
    engine.add(make_vdb_stage(names, k));
  engine.add(make_junction_stage(names, recipe));
  engine.add(make_bind_stage(names, recipe));
  engine.add(make_texture_stage(names, recipe));
  for (std::size_t s = 0; s < sources.size(); ++s) engine.add(make_motion_stage(names, s, sources[s]));
  for (const ClipRequest& clip : clips)
    engine.add(make_complete_clip_stage(names, recipe, sources.size(), clip));
  if (recipe.correctives.method != RecipeDeform::None) engine.add(make_correct_stage(names, recipe, clips));
  engine.add(make_export_stage(names, recipe, clips));
  engine.add(make_validate_stage(names, recipe));
  if (recipe.golden) add_golden(recipe, engine, names);
  if (level != ReportLevel::None) add_report(recipe, clips, sources.size(), level, engine, names);
  if (!recipe.expect.is_empty()) engine.add(make_expect_stage(names, recipe));  // nothing waits for these two
  if (recipe.golden) engine.add(make_golden_stage(names, *recipe.golden));
}

void add_preview(const Recipe& recipe, Engine& engine, const ArtifactNames& names) {
  const std::vector<ClipRequest> clips = clip_requests(recipe, engine, names);
  engine.add(make_place_stage(names, recipe));
  engine.add(make_turn_stage(names, recipe));
  engine.add(make_graft_skeleton_stage(names, recipe));
  engine.add(make_map_joints_stage(names, recipe));
  engine.add(make_preview_stage(names, recipe, clips));
}

std::vector<OutputFile> preview_outputs(const Recipe& recipe, ReportLevel level, const ArtifactNames& names) {
  std::vector<OutputFile> files{{preview_name(recipe), names.preview_glb()}};
  if (level != ReportLevel::None) files.push_back({"report-preview.json", names.preview_report()});
  return files;
}

std::vector<OutputFile> outputs(const Recipe& recipe, Engine& engine, ReportLevel level,
                                const ArtifactNames& names) {
  std::vector<OutputFile> files;
  if (!recipe.output.glb.empty()) files.push_back({recipe.output.glb, names.glb()});
  if (!recipe.output.obj.empty()) files.push_back({recipe.output.obj, names.obj()});
  if (recipe.correctives.method == RecipeDeform::Context)
    files.push_back({recipe.name + "_driver.json", names.driver()});
  for (std::size_t k = 0; k < recipe.operations.size() && !recipe.output.vdb.empty(); ++k) {
    const std::filesystem::path vdb(recipe.output.vdb);
    const std::string name = k == 0 ? vdb.string()
                                    : (vdb.parent_path() / fmt::format("{}_{}{}", vdb.stem().string(), k + 1,
                                                                       vdb.extension().string()))
                                          .string();
    if (engine.has(names.vdb(k)) && engine.size(names.vdb(k)) > 0) files.push_back({name, names.vdb(k)});
  }
  if (level == ReportLevel::None) return files;
  files.push_back({"report.json", names.report()});
  const std::vector<ClipRequest> clips = clip_requests(recipe, engine, names);
  const std::vector<std::string> strips = clip_picture_names(clips);
  for (std::size_t c = 0; c < clips.size(); ++c)
    if (clips[c].is_animated)
      files.push_back({"pictures/" + strips[c] + ".apng", names.animated(clips[c].name)});
  if (level == ReportLevel::Full)
    for (const std::string& picture : picture_names(recipe, clips))
      files.push_back({file_name_of_picture(picture), names.picture(picture)});
  return files;
}

}  // namespace skinforge
