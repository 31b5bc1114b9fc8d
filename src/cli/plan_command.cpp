#include <fmt/core.h>

#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/text.h"
#include "cli/commands.h"
#include "cli/planning.h"
#include "cli/recipe_tasks.h"
#include "cli/session.h"
#include "stages/build.h"

namespace skinforge {
using nlohmann::json;

namespace {
// Seconds by label, of stages when they last ran.
using Seconds = std::map<std::string, double>;

std::optional<double> predicted(const StagePlan& plan, const Seconds& seconds) {
  const auto found = seconds.find(plan.info.label());
  return plan.state == PlanState::Hit || found == seconds.end() ? std::nullopt : std::optional(found->second);
}

std::string total_text(const std::vector<StagePlan>& plans, const Seconds& seconds) {
  std::size_t to_run = 0, unknown = 0;
  double total = 0;
  for (const StagePlan& plan : plans) {
    if (plan.state == PlanState::Hit) continue;
    ++to_run;
    const auto time = predicted(plan, seconds);
    total += time.value_or(0);
    unknown += !time;
  }
  if (to_run == 0 || unknown == to_run) return "";
  return fmt::format("      {} stages, {:.2f} s when they last ran{}\n", to_run, total,
                     unknown > 0 ? fmt::format(" ({} never did)", unknown) : "");
}

std::string text_of(const std::vector<StagePlan>& plans, const Seconds& seconds, bool is_complete) {
  std::string text;
  for (const StagePlan& plan : plans)
    text += fmt::format("{:<5} {}{}\n", state_name(plan.state), printable(plan.info.label()),
                        plan.reason.empty() ? "" : "  (" + printable(plan.reason) + ")");
  if (!is_complete) text += "      further stages follow from the clips of the inputs\n";
  return text + total_text(plans, seconds);
}

json to_json(const std::vector<StagePlan>& plans, const Recipe& recipe, const Seconds& seconds) {
  json list = json::array();
  for (const StagePlan& plan : plans) {
    json stage = {{"stage", plan.info.label()}, {"state", state_name(plan.state)}};
    if (!plan.reason.empty()) stage["reason"] = plan.reason;
    if (const auto time = predicted(plan, seconds)) stage["predicted_seconds"] = *time;
    if (plan.state != PlanState::Hit) stage["changes"] = to_json(plan.changes, recipe);
    list.push_back(std::move(stage));
  }
  return list;
}
}  // namespace

ExitCode plan_command(const CommandLine& line, Console& console) {
  json list = json::array();
  for (const RecipeTask& task : recipe_tasks(line)) {
    if (task.code != ExitCode::Ok) throw Error(task.code, task.error);
    Session session(line, task.resolved, console);
    const auto [plans, is_complete] = plan_recipe(session);
    session.tell_trouble();
    const Seconds seconds = session.last_seconds();
    if (!line.json) print_data(session.recipe().name + "\n" + text_of(plans, seconds, is_complete));
    list.push_back({{"recipe", task.recipe},
                    {"variant", task.resolved.variant},
                    {"name", session.recipe().name},
                    {"is_complete", is_complete},
                    {"stages", to_json(plans, session.recipe(), seconds)}});
  }
  const json document = {{"recipes", std::move(list)}, {"exit_code", 0}};
  if (line.json) print_data(document.dump(2, ' ', false, json::error_handler_t::replace));
  return ExitCode::Ok;
}

}  // namespace skinforge
