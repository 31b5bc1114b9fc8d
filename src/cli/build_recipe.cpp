#include "cli/build_recipe.h"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <regex>

#include "base/text.h"
#include "cli/accept.h"
#include "cli/commands.h"
#include "cli/event_stream.h"
#include "cli/report_page.h"
#include "recipe/recipe_files.h"
#include "report/report_json.h"
#include "stages/build.h"
#include "stages/expect_stage.h"
#include "stages/stage_settings.h"

namespace skinforge {
using nlohmann::json;
namespace fs = std::filesystem;

namespace {
fs::path output_folder(const CommandLine& line, const Recipe& recipe, bool is_alone) {
  if (line.out.empty()) return fs::path("out") / recipe.name;
  return is_alone ? fs::path(line.out) : fs::path(line.out) / recipe.name;
}

bool has_run(const std::vector<StageResult>& stages) {
  return std::any_of(stages.begin(), stages.end(),
                     [](const auto& s) { return s.status == StageStatus::Ran; });
}

// Over budget or unlike the golden, but there to be looked at.
bool has_failed_only_verdicts(Session& session) {
  const auto results = session.engine().results();
  return std::all_of(results.begin(), results.end(), [](const StageResult& stage) {
    return stage.status == StageStatus::Hit || stage.status == StageStatus::Ran || is_verdict(stage.info);
  });
}

bool has_changed(const Outcome& outcome) {
  return has_run(outcome.stages) || std::any_of(outcome.files.begin(), outcome.files.end(),
                                                [](const PublishedFile& file) { return file.was_written; });
}

void build_session(const CommandLine& line, Session& session, Outcome& outcome) {
  bool is_ok = session.import();
  if (is_ok) {
    session.add_grafts();
    is_ok = session.run();
  }
  const bool is_whole = is_ok || has_failed_only_verdicts(session);
  if (is_whole) {
    const auto files = line.preview ? preview_outputs(session.recipe(), line.report)
                                    : outputs(session.recipe(), session.engine(), line.report);
    outcome.files = publish(session.engine(), files, outcome.folder, all_files(session.recipe()));
  }
  outcome.stages = session.engine().results();
  session.note_usage();
  if (is_whole && !line.preview) write_run_files(session, line.report, outcome.folder, has_changed(outcome));
  session.tell_trouble();
  if (const auto failure = session.failure()) {
    outcome.code = exit_code(failure);
    outcome.error = session.message_of(*failure);
  }
}

void tell(const Outcome& outcome, Console& console) {
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
                           hits, outcome.seconds));
}

// "base.json:12:9: ..." at the start of a message; where none stands there, it is about the whole recipe.
void read_place(const std::string& text, BuildVerdict& verdict) {
  static const std::regex kPlace(R"(^([^:]+):(\d+):(\d+)(:|$))");
  std::smatch found;
  if (!std::regex_search(text, found, kPlace)) return;
  verdict.recipe = found[1];
  verdict.line = std::stoi(found[2]);
  verdict.column = std::stoi(found[3]);
}
}  // namespace

Outcome build_recipe(const CommandLine& line, const RecipeTask& task, Console& console, EventStream& events,
                     WorkShare& share, bool is_alone) {
  const auto begin = std::chrono::steady_clock::now();
  RecipeEvents recipe_events(events, task.recipe, task.resolved.variant);
  recipe_events.started();
  Outcome outcome;
  outcome.recipe = task.recipe;
  outcome.variant = task.resolved.variant;
  const auto fail = [&](ExitCode code, const std::string& message) {
    outcome.code = code;
    outcome.error = message;
    console.error(printable(message));
  };
  try {
    if (task.code != ExitCode::Ok) throw Error(task.code, task.error);
    if (line.accept) {
      Session accepting(line, task.resolved, console, nullptr, &share);
      accept_golden(accepting, console);
    }
    Session session(line, task.resolved, console, &recipe_events, &share);
    outcome.name = session.recipe().name;
    outcome.folder = output_folder(line, session.recipe(), is_alone);
    build_session(line, session, outcome);
  } catch (const Error& error) {
    fail(error.code(), error.what());
  } catch (const std::bad_alloc&) {
    fail(ExitCode::StageFailed, "not enough memory");
  } catch (const std::exception& error) {
    fail(ExitCode::Internal, std::string("internal error: ") + error.what());
  }
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  outcome.seconds = seconds.count();
  recipe_events.finished(outcome.name, outcome.code, outcome.error, outcome.seconds);
  tell(outcome, console);
  return outcome;
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

BuildVerdict verdict_of(const Outcome& outcome) {
  BuildVerdict verdict;
  verdict.label = outcome.variant.empty() ? outcome.recipe : outcome.recipe + " " + outcome.variant;
  verdict.recipe = outcome.recipe;
  verdict.code = outcome.code;
  verdict.error = printable(outcome.error);
  verdict.seconds = outcome.seconds;
  if (outcome.code != ExitCode::Ok) read_place(outcome.error, verdict);
  verdict.stages = outcome.stages.size();
  for (const StageResult& stage : outcome.stages) {
    if (stage.status == StageStatus::Hit) ++verdict.hits;
    if (stage.status == StageStatus::Failed && verdict.stage.empty()) verdict.stage = stage.info.label();
    for (const Issue& issue : stage.issues)
      if (issue.severity == Severity::Warning) verdict.warnings.push_back(issue);
  }
  return verdict;
}

}  // namespace skinforge
