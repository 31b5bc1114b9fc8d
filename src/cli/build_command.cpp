#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>

#include "base/text.h"
#include "base/version.h"
#include "cli/build_pool.h"
#include "cli/commands.h"
#include "cli/event_stream.h"
#include "pipeline/work_share.h"

namespace skinforge {
using nlohmann::json;

namespace {
constexpr double kBytesPerGigabyte = 1e9;

// Two recipes of one name would write into one folder.
void refuse_same_names(std::vector<RecipeTask>& tasks) {
  std::map<std::string, const RecipeTask*> known;
  for (RecipeTask& task : tasks) {
    const Value* name = task.resolved.root.find("name");
    if (task.code != ExitCode::Ok || !name || name->text.empty()) continue;
    const auto [first, is_new] = known.emplace(name->text, &task);
    if (is_new) continue;
    task.code = ExitCode::Usage;
    task.error = name->where() + ": " + first->second->label() + " is called \"" + printable(name->text) +
                 "\", too, and both would write the same files";
  }
}

ExitCode overall(const CommandLine& line, const std::vector<Outcome>& outcomes) {
  for (const Outcome& outcome : outcomes)
    if (outcome.code != ExitCode::Ok) return line.keep_going ? ExitCode::SomeFailed : outcome.code;
  return ExitCode::Ok;
}

void write_for_ci(const CommandLine& line, const std::vector<Outcome>& outcomes) {
  std::vector<BuildVerdict> verdicts;
  for (const Outcome& outcome : outcomes) verdicts.push_back(verdict_of(outcome));
  if (!line.junit.empty()) write_output(line.junit, junit_xml(verdicts));
  if (!line.sarif.empty()) write_output(line.sarif, sarif(verdicts, kVersion));
  if (!line.summary.empty()) write_output(line.summary, markdown_summary(verdicts));
  const char* actions = std::getenv("GITHUB_ACTIONS");
  if (actions && std::string_view(actions) == "true")
    std::fputs(github_annotations(verdicts).c_str(), stderr);
}

void print_json(const std::vector<Outcome>& outcomes, ExitCode code) {
  json list = json::array();
  for (const Outcome& outcome : outcomes) list.push_back(to_json(outcome));
  const json document = {{"recipes", std::move(list)}, {"exit_code", static_cast<int>(code)}};
  print_data(document.dump(2, ' ', false, json::error_handler_t::replace));
}
}  // namespace

ExitCode build_command(const CommandLine& line, Console& console) {
  std::vector<RecipeTask> tasks = recipe_tasks(line);
  refuse_same_names(tasks);
  WorkShare share(line.jobs, static_cast<std::uint64_t>(line.memory_gb * kBytesPerGigabyte));
  EventStream events(line.events);
  events.build_started(tasks.size());
  std::vector<Outcome> outcomes;
  if (tasks.size() == 1) {
    const bool is_alone = line.recipes.size() == 1 && line.shard.empty();
    outcomes.push_back(build_recipe(line, tasks.front(), console, events, share, is_alone));
  } else {
    outcomes = build_all(line, tasks, share, console, events);
  }
  const ExitCode code = overall(line, outcomes);
  events.build_finished(code);
  write_for_ci(line, outcomes);
  if (line.json) print_json(outcomes, code);
  return code;
}

}  // namespace skinforge
