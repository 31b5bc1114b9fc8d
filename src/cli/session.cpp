#include "cli/session.h"

#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/text.h"
#include "cli/build_id.h"
#include "pipeline/cache_usage.h"
#include "recipe/recipe_files.h"
#include "stages/build.h"
#include "stages/stage_settings.h"

namespace skinforge {
using nlohmann::json;
namespace fs = std::filesystem;

namespace {
// Not what comes of time, memory, limits or a child process: those may go better next time. Reading a file is
// quick.
bool would_fail_again(const StageInfo& stage, ExitCode code) {
  const bool has_limits = stage.name == "import" || stage.name == "rig" || stage.name == "field";
  return !has_limits &&
         (code == ExitCode::StageFailed || code == ExitCode::Usage || code == ExitCode::BadInput ||
          code == ExitCode::Invalid || code == ExitCode::Different);
}
}  // namespace

std::string session_name(const ResolvedRecipe& recipe) {
  std::error_code error;
  const fs::path path = fs::weakly_canonical(recipe.path, error);
  return (error ? recipe.path : path).string() + (recipe.variant.empty() ? "" : " " + recipe.variant);
}

const char* status_name(StageStatus status) {
  switch (status) {
    case StageStatus::Hit:
      return "hit";
    case StageStatus::Ran:
      return "ran";
    case StageStatus::Failed:
      return "failed";
    case StageStatus::Skipped:
      return "skipped";
  }
  return "";
}

Session::Session(const CommandLine& line, const ResolvedRecipe& recipe, Console& console,
                 RecipeEvents* events, WorkShare* share)
    : line_(line),
      console_(console),
      recipe_(read_resolved(recipe)),
      name_(session_name(recipe)),
      store_(line.cache, &digests_),
      cache_(store_),
      progress_(console, events),
      engine_(cache_, {.jobs = line.jobs,
                       .build = build_id(),
                       .session = name_,
                       .observer = &progress_,
                       .remembers_failure = would_fail_again,
                       .retry_failed = line.retry_failed,
                       .verify = line.verify,
                       .settings = recipe_settings(recipe_),
                       .reads_setting = reads_setting,
                       .share = share,
                       .digests = &digests_}) {
  cache_.recall_digests(name_, digests_);
  if (console.has_status_line()) progress_.expect(last_seconds());
  expect_inputs_under(line.choice.inputs_under);
}

void Session::expect_inputs_under(const std::vector<std::string>& folders) const {
  if (folders.empty()) return;
  std::vector<fs::path> files = input_files(recipe_), goldens = golden_files(recipe_);
  files.insert(files.end(), goldens.begin(), goldens.end());
  for (const fs::path& file : files)
    if (!lies_under(file, folders))
      throw Error(ExitCode::Usage, fmt::format("{}: input {} is not below a folder of --inputs-under",
                                               recipe_.where("/inputs"), printable(file.string())));
}

bool Session::add_imports() {
  return skinforge::add_imports(recipe_, engine_, [this] { run(); });
}

bool Session::import() {
  const bool is_complete = add_imports();
  return run() && is_complete;
}

bool Session::plan_import() {
  const auto look_up = [this] { engine_.plan(); };
  const bool is_complete = skinforge::add_imports(recipe_, engine_, look_up);
  look_up();
  return is_complete && knows_contents(recipe_, engine_);
}

void Session::add_grafts() {
  if (line_.preview)
    add_preview(recipe_, engine_);
  else
    skinforge::add_grafts(recipe_, engine_, line_.report);
}

bool Session::run() {
  progress_.set_total(engine_.stages().size());
  engine_.run();
  progress_.end();
  return engine_.is_ok();
}

bool Session::run_for(const std::vector<std::string>& artifacts) {
  progress_.set_total(engine_.stages().size());
  engine_.run_for(artifacts);
  progress_.end();
  return engine_.is_ok();
}

std::vector<RunRecord> Session::runs() {
  std::vector<RunRecord> runs = cache_.past_runs(name_);
  if (RunRecord last = cache_.last_run(name_); !last.stages.empty())
    runs.insert(runs.begin(), std::move(last));
  return runs;
}

std::map<std::string, double> Session::last_seconds() {
  std::map<std::string, double> seconds;
  for (const auto& [label, stage] : cache_.last_run(name_).stages)
    if (const auto manifest = cache_.peek(stage.key)) seconds[label] = manifest->cost.wall_seconds;
  return seconds;
}

void Session::note_usage() {
  CacheUsage usage{.builds = 1};
  for (const StageResult& stage : engine_.results()) {
    if (stage.status == StageStatus::Skipped) continue;
    const bool is_hit = stage.status == StageStatus::Hit;
    ++(is_hit ? usage.hits : usage.runs);
    (is_hit ? usage.saved_seconds : usage.spent_seconds) += stage.cost.wall_seconds;
  }
  skinforge::note_usage(store_, name_, usage);
  cache_.keep_digests(name_, digests_);
}

Timings Session::timings() const {
  Timings timings;
  for (const StageResult& stage : engine_.results()) {
    const auto peak = static_cast<std::int64_t>(stage.cost.peak_bytes);
    timings.stages.push_back({stage.info.name, stage.info.instance, status_name(stage.status),
                              stage.cost.wall_seconds, stage.cost.cpu_seconds, peak,
                              progress_.begin_of(stage.info.label())});
    timings.wall += stage.cost.wall_seconds;
    timings.cpu += stage.cost.cpu_seconds;
    timings.peak_memory = std::max(timings.peak_memory, peak);
  }
  return timings;
}

std::optional<StageResult> Session::failure() const {
  for (const StageResult& result : engine_.results())
    if (result.status == StageStatus::Failed) return result;
  return std::nullopt;
}

std::string Session::message_of(const StageResult& stage) const {
  const auto setting = setting_of(stage);
  return setting ? recipe_.place(*setting) + ": " + stage.error : stage.error;
}

void Session::tell_trouble() {
  for (const Issue& issue : cache_.take_warnings()) console_.issue(issue);
  std::size_t skipped = 0;
  for (const StageResult& result : engine_.results()) {
    if (result.status == StageStatus::Failed)
      console_.error(
          printable(fmt::format("{} (stage {}{})", message_of(result), result.info.label(),
                                result.is_remembered ? ", as before; --retry-failed runs it again" : "")));
    if (result.status == StageStatus::Skipped) ++skipped;
  }
  if (skipped > 0) console_.info(fmt::format("{} stages that depend on it were skipped", skipped));
}

std::optional<std::string> setting_of(const StageResult& stage) {
  for (const std::string& artifact : stage.info.reads)
    if (auto setting = setting_of_source(artifact)) return setting;
  return std::nullopt;
}

ExitCode exit_code(const std::optional<StageResult>& failure) {
  return failure ? failure->code : ExitCode::Ok;
}

json to_json(const std::vector<Issue>& issues) {
  json list = json::array();
  for (const Issue& issue : issues)
    list.push_back({{"code", issue.code},
                    {"severity", issue.severity == Severity::Warning ? "warning" : "note"},
                    {"place", issue.place},
                    {"message", issue.message}});
  return list;
}

json to_json(const std::vector<StageResult>& results) {
  json list = json::array();
  for (const StageResult& result : results) {
    json stage = {{"stage", result.info.label()},
                  {"status", status_name(result.status)},
                  {"key", result.key.hex()},
                  {"wall_seconds", result.cost.wall_seconds},
                  {"cpu_seconds", result.cost.cpu_seconds},
                  {"peak_bytes", result.cost.peak_bytes},
                  {"issues", to_json(result.issues)}};
    if (!result.reason.empty()) stage["reason"] = result.reason;
    if (!result.error.empty()) stage["error"] = result.error;
    if (result.is_remembered) stage["remembered"] = true;
    list.push_back(std::move(stage));
  }
  return list;
}

}  // namespace skinforge
