#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>

#include "base/text.h"
#include "cli/commands.h"
#include "cli/session.h"
#include "pipeline/publish.h"
#include "report/report_json.h"
#include "stages/build.h"

namespace skinforge {
using nlohmann::json;
namespace fs = std::filesystem;

namespace {
// How one recipe of the command line went.
struct Outcome {
  std::string recipe;
  std::string name;
  fs::path folder;
  ExitCode code = ExitCode::Ok;
  std::string error;
  std::vector<StageResult> stages;
  std::vector<PublishedFile> files;
};

fs::path output_folder(const CommandLine& line, const Recipe& recipe) {
  if (line.out.empty()) return fs::path("out") / recipe.name;
  return line.recipes.size() == 1 ? fs::path(line.out) : fs::path(line.out) / recipe.name;
}

// Files that a build reads and must not overwrite, those of recipes inside the recipe too.
void collect_inputs(const Recipe& recipe, std::vector<fs::path>& files) {
  files.push_back(recipe.path);
  for (const RecipeInput& input : recipe.inputs) {
    files.push_back(input.file.resolved);
    for (const RecipePath& clips : input.clips) files.push_back(clips.resolved);
    if (input.bind)
      for (const RecipePath& path : {input.bind->skeleton, input.bind->handle_file})
        if (!path.text.empty()) files.push_back(path.resolved);
    if (input.recipe) collect_inputs(*input.recipe, files);
  }
  for (const RecipeExample& example : recipe.correctives.examples) {
    files.push_back(example.shape.resolved);
    files.push_back(example.pose.resolved);
  }
}

// What each stage cost when it ran, which may have been in an earlier build. A file of its own, so that the
// report compares byte for byte.
void write_timings(const std::vector<StageResult>& stages, const fs::path& folder) {
  Timings timings;
  for (const StageResult& stage : stages) {
    const auto peak = static_cast<std::int64_t>(stage.cost.peak_bytes);
    timings.stages.push_back({stage.info.name, stage.info.instance, status_name(stage.status),
                              stage.cost.wall_seconds, stage.cost.cpu_seconds, peak});
    timings.wall += stage.cost.wall_seconds;
    timings.cpu += stage.cost.cpu_seconds;
    timings.peak_memory = std::max(timings.peak_memory, peak);
  }
  const std::string text = skinforge::to_json(timings);
  if (!write_file_atomically(folder / "timings.json", std::as_bytes(std::span(text))))
    throw Error(ExitCode::StageFailed, (folder / "timings.json").string() + ": cannot write this file");
}

bool has_run(const std::vector<StageResult>& stages) {
  return std::any_of(stages.begin(), stages.end(),
                     [](const auto& s) { return s.status == StageStatus::Ran; });
}

void build_session(const CommandLine& line, Session& session, Outcome& outcome) {
  bool is_ok = session.import();
  if (is_ok) {
    session.add_grafts();
    is_ok = session.run();
  }
  if (is_ok) {
    std::vector<fs::path> inputs;
    collect_inputs(session.recipe(), inputs);
    const auto files = line.preview ? preview_outputs(session.recipe(), line.report)
                                    : outputs(session.recipe(), session.engine(), line.report);
    outcome.files = publish(session.engine(), files, outcome.folder, inputs);
  }
  outcome.stages = session.engine().results();
  const bool wants_timings = is_ok && !line.preview && line.report != ReportLevel::None;
  if (wants_timings && (has_run(outcome.stages) || !fs::exists(outcome.folder / "timings.json")))
    write_timings(outcome.stages, outcome.folder);
  session.tell_trouble();
  if (const auto failure = session.failure()) {
    outcome.code = exit_code(failure);
    outcome.error = failure->error;
  }
}

Outcome build_recipe(const CommandLine& line, const std::string& path, Console& console) {
  Outcome outcome;
  outcome.recipe = path;
  try {
    Session session(line, path, console);
    outcome.name = session.recipe().name;
    outcome.folder = output_folder(line, session.recipe());
    build_session(line, session, outcome);
  } catch (const Error& error) {
    outcome.code = error.code();
    outcome.error = error.what();
    console.error(printable(outcome.error));
  }
  return outcome;
}

void tell(const Outcome& outcome, double seconds, Console& console) {
  if (outcome.code != ExitCode::Ok) return;
  for (const PublishedFile& file : outcome.files) {
    const std::string text =
        fmt::format("{} ({})", (outcome.folder / file.name).string(), readable_size(file.size));
    if (file.was_written)
      console.info(text);
    else
      console.detail(text + ", unchanged");
  }
  const auto hits = std::count_if(outcome.stages.begin(), outcome.stages.end(),
                                  [](const auto& s) { return s.status == StageStatus::Hit; });
  console.info(fmt::format("{}: {} stages, {} from the cache, {:.2f} s", outcome.name, outcome.stages.size(),
                           hits, seconds));
}

json to_json(const Outcome& outcome) {
  json files = json::array();
  for (const PublishedFile& file : outcome.files)
    files.push_back({{"name", file.name},
                     {"sha256", file.digest.hex()},
                     {"size", file.size},
                     {"written", file.was_written}});
  json result = {{"recipe", outcome.recipe},       {"name", outcome.name},
                 {"out", outcome.folder.string()}, {"exit_code", static_cast<int>(outcome.code)},
                 {"files", std::move(files)},      {"stages", to_json(outcome.stages)}};
  if (!outcome.error.empty()) result["error"] = outcome.error;
  return result;
}

ExitCode overall(const CommandLine& line, const std::vector<Outcome>& outcomes) {
  for (const Outcome& outcome : outcomes)
    if (outcome.code != ExitCode::Ok) return line.keep_going ? ExitCode::SomeFailed : outcome.code;
  return ExitCode::Ok;
}
}  // namespace

ExitCode build_command(const CommandLine& line, Console& console) {
  std::vector<Outcome> outcomes;
  for (const std::string& recipe : line.recipes) {
    const auto begin = std::chrono::steady_clock::now();
    outcomes.push_back(build_recipe(line, recipe, console));
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    tell(outcomes.back(), seconds.count(), console);
    if (outcomes.back().code != ExitCode::Ok && !line.keep_going) break;
  }
  const ExitCode code = overall(line, outcomes);
  if (line.json) {
    json list = json::array();
    for (const Outcome& outcome : outcomes) list.push_back(to_json(outcome));
    const json document = {{"recipes", std::move(list)}, {"exit_code", static_cast<int>(code)}};
    print_data(document.dump(2, ' ', false, json::error_handler_t::replace));
  }
  return code;
}

}  // namespace skinforge
