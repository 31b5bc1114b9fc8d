#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "base/text.h"
#include "cli/commands.h"
#include "cli/session.h"
#include "stages/build.h"

namespace skinforge {
using nlohmann::json;

namespace {
const char* state_name(PlanState state) {
  switch (state) {
    case PlanState::Hit:
      return "hit";
    case PlanState::Run:
      return "run";
    case PlanState::Waits:
      return "waits";
  }
  return "";
}

// Plans of one recipe; the later stages are listed once the contents of all inputs are in the cache.
std::vector<StagePlan> plan_recipe(Session& session, bool& is_complete) {
  is_complete = session.plan_import();
  if (is_complete) session.add_grafts();
  return session.engine().plan();
}

std::string text_of(const std::vector<StagePlan>& plans, bool is_complete) {
  std::string text;
  for (const StagePlan& plan : plans)
    text += fmt::format("{:<5} {}{}\n", state_name(plan.state), printable(plan.info.label()),
                        plan.reason.empty() ? "" : "  (" + printable(plan.reason) + ")");
  if (!is_complete) text += "      further stages follow from the clips of the inputs\n";
  return text;
}

json to_json(const std::vector<StagePlan>& plans) {
  json list = json::array();
  for (const StagePlan& plan : plans) {
    json stage = {{"stage", plan.info.label()}, {"state", state_name(plan.state)}};
    if (!plan.reason.empty()) stage["reason"] = plan.reason;
    list.push_back(std::move(stage));
  }
  return list;
}
}  // namespace

ExitCode plan_command(const CommandLine& line, Console& console) {
  json list = json::array();
  for (const std::string& path : line.recipes) {
    Session session(line, path, console);
    bool is_complete = false;
    const std::vector<StagePlan> plans = plan_recipe(session, is_complete);
    session.tell_trouble();
    if (!line.json) print_data(session.recipe().name + "\n" + text_of(plans, is_complete));
    list.push_back({{"recipe", path},
                    {"name", session.recipe().name},
                    {"is_complete", is_complete},
                    {"stages", to_json(plans)}});
  }
  const json document = {{"recipes", std::move(list)}, {"exit_code", 0}};
  if (line.json) print_data(document.dump(2, ' ', false, json::error_handler_t::replace));
  return ExitCode::Ok;
}

}  // namespace skinforge
