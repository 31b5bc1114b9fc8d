#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <regex>

#include "base/text.h"
#include "base/version.h"
#include "cli/commands.h"
#include "cli/event_stream.h"
#include "cli/recipe_tasks.h"
#include "cli/report_page.h"
#include "cli/session.h"
#include "pipeline/publish.h"
#include "recipe/recipe_files.h"
#include "report/build_verdict.h"
#include "report/report_json.h"
#include "stages/build.h"
#include "stages/expect_stage.h"
#include "stages/stage_settings.h"

namespace skinforge {
using nlohmann::json;
namespace fs = std::filesystem;

namespace {
// How one recipe of the command line went.
struct Outcome {
  std::string recipe;
  std::string variant;
  std::string name;
  fs::path folder;
  ExitCode code = ExitCode::Ok;
  std::string error;
  std::string place;  // in the recipe, "centaur.json:12:9", of what failed; empty where the error says it
  double seconds = 0;
  std::vector<StageResult> stages;
  std::vector<PublishedFile> files;
};

fs::path output_folder(const CommandLine& line, const Recipe& recipe, bool is_alone) {
  if (line.out.empty()) return fs::path("out") / recipe.name;
  return is_alone ? fs::path(line.out) : fs::path(line.out) / recipe.name;
}

// Files that a build reads and must not overwrite.
std::vector<fs::path> files_read(const Recipe& recipe) {
  std::vector<fs::path> files = input_files(recipe), recipes = recipe_files(recipe);
  files.insert(files.end(), recipes.begin(), recipes.end());
  return files;
}

void write_text(const fs::path& file, const std::string& text) {
  write_output(file, std::as_bytes(std::span(text)));
}

bool has_run(const std::vector<StageResult>& stages) {
  return std::any_of(stages.begin(), stages.end(),
                     [](const auto& s) { return s.status == StageStatus::Ran; });
}

bool has_failed_only_budgets(Session& session) {
  const auto results = session.engine().results();
  return std::all_of(results.begin(), results.end(), [](const StageResult& stage) {
    return stage.status == StageStatus::Hit || stage.status == StageStatus::Ran ||
           stage.info.name == kExpectStage;
  });
}

// What differs from run to run, in files of its own, so that the others compare byte for byte.
void write_run_files(const CommandLine& line, Session& session, const Outcome& outcome) {
  const bool is_changed =
      has_run(outcome.stages) || std::any_of(outcome.files.begin(), outcome.files.end(),
                                             [](const PublishedFile& file) { return file.was_written; });
  const fs::path timings = outcome.folder / "timings.json", page = outcome.folder / "report.html";
  if (line.report != ReportLevel::None && (is_changed || !fs::exists(timings)))
    write_text(timings, skinforge::to_json(session.timings()));
  if (line.report == ReportLevel::Full && (is_changed || !fs::exists(page)))
    write_text(page, report_page(session));
}

void build_session(const CommandLine& line, Session& session, Outcome& outcome) {
  bool is_ok = session.import();
  if (is_ok) {
    session.add_grafts();
    is_ok = session.run();
  }
  if (is_ok || has_failed_only_budgets(session)) {  // over budget, but there to be looked at
    const auto files = line.preview ? preview_outputs(session.recipe(), line.report)
                                    : outputs(session.recipe(), session.engine(), line.report);
    outcome.files = publish(session.engine(), files, outcome.folder, files_read(session.recipe()));
  }
  outcome.stages = session.engine().results();
  session.note_usage();
  if ((is_ok || has_failed_only_budgets(session)) && !line.preview) write_run_files(line, session, outcome);
  session.tell_trouble();
  if (const auto failure = session.failure()) {
    outcome.code = exit_code(failure);
    outcome.error = failure->error;
    outcome.place = session.recipe().where(setting_of(*failure).value_or(""));
  }
}

Outcome build_recipe(const CommandLine& line, const RecipeTask& task, Console& console, EventStream& events,
                     bool is_alone) {
  Outcome outcome;
  outcome.recipe = task.recipe;
  outcome.variant = task.resolved.variant;
  try {
    if (task.code != ExitCode::Ok) throw Error(task.code, task.error);
    Session session(line, task.resolved, console, &events);
    outcome.name = session.recipe().name;
    outcome.folder = output_folder(line, session.recipe(), is_alone);
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
  json result = {{"recipe", outcome.recipe},
                 {"variant", outcome.variant},
                 {"name", outcome.name},
                 {"out", outcome.folder.string()},
                 {"exit_code", static_cast<int>(outcome.code)},
                 {"id", rule_name(outcome.code)},
                 {"files", std::move(files)},
                 {"stages", to_json(outcome.stages)}};
  if (!outcome.error.empty()) result["error"] = outcome.error;
  return result;
}

ExitCode overall(const CommandLine& line, const std::vector<Outcome>& outcomes) {
  for (const Outcome& outcome : outcomes)
    if (outcome.code != ExitCode::Ok) return line.keep_going ? ExitCode::SomeFailed : outcome.code;
  return ExitCode::Ok;
}
// "base.json:12:9: ..." at the start of a message; false where none stands there.
bool read_place(const std::string& text, BuildVerdict& verdict) {
  static const std::regex kPlace(R"(^([^:]+):(\d+):(\d+)(:|$))");
  std::smatch found;
  if (!std::regex_search(text, found, kPlace)) return false;
  verdict.recipe = found[1];
  verdict.line = std::stoi(found[2]);
  verdict.column = std::stoi(found[3]);
  return true;
}

BuildVerdict verdict_of(const Outcome& outcome) {
  BuildVerdict verdict;
  verdict.label = outcome.variant.empty() ? outcome.recipe : outcome.recipe + " " + outcome.variant;
  verdict.recipe = outcome.recipe;
  verdict.code = outcome.code;
  verdict.error = printable(outcome.error);
  verdict.seconds = outcome.seconds;
  if (outcome.code != ExitCode::Ok && !read_place(outcome.error, verdict)) read_place(outcome.place, verdict);
  verdict.stages = outcome.stages.size();
  for (const StageResult& stage : outcome.stages) {
    if (stage.status == StageStatus::Hit) ++verdict.hits;
    if (stage.status == StageStatus::Failed && verdict.stage.empty()) verdict.stage = stage.info.label();
    for (const Issue& issue : stage.issues)
      if (issue.severity == Severity::Warning) verdict.warnings.push_back(issue);
  }
  return verdict;
}

void write_for_ci(const CommandLine& line, const std::vector<Outcome>& outcomes) {
  std::vector<BuildVerdict> verdicts;
  for (const Outcome& outcome : outcomes) verdicts.push_back(verdict_of(outcome));
  if (!line.junit.empty()) write_text(line.junit, junit_xml(verdicts));
  if (!line.sarif.empty()) write_text(line.sarif, sarif(verdicts, kVersion));
  if (!line.summary.empty()) write_text(line.summary, markdown_summary(verdicts));
  const char* actions = std::getenv("GITHUB_ACTIONS");
  if (actions && std::string_view(actions) == "true")
    std::fputs(github_annotations(verdicts).c_str(), stderr);
}
}  // namespace

ExitCode build_command(const CommandLine& line, Console& console) {
  std::vector<Outcome> outcomes;
  std::vector<RecipeTask> tasks = recipe_tasks(line);
  const bool is_alone = line.recipes.size() == 1 && tasks.size() == 1 && line.shard.empty();
  EventStream events(line.events);
  events.build_started(tasks.size());
  for (const RecipeTask& task : tasks) {
    events.recipe_started(task.recipe, task.resolved.variant);
    const auto begin = std::chrono::steady_clock::now();
    outcomes.push_back(build_recipe(line, task, console, events, is_alone));
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    outcomes.back().seconds = seconds.count();
    events.recipe_finished(outcomes.back().name, outcomes.back().code, outcomes.back().error,
                           seconds.count());
    tell(outcomes.back(), seconds.count(), console);
    if (outcomes.back().code != ExitCode::Ok && !line.keep_going) break;
  }
  const ExitCode code = overall(line, outcomes);
  events.build_finished(code);
  write_for_ci(line, outcomes);
  if (line.json) {
    json list = json::array();
    for (const Outcome& outcome : outcomes) list.push_back(to_json(outcome));
    const json document = {{"recipes", std::move(list)}, {"exit_code", static_cast<int>(code)}};
    print_data(document.dump(2, ' ', false, json::error_handler_t::replace));
  }
  return code;
}

}  // namespace skinforge
