#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/text.h"
#include "cli/commands.h"
#include "cli/recipe_tasks.h"
#include "cli/session.h"
#include "stages/build.h"

namespace skinforge {
using nlohmann::json;

namespace {
std::optional<StageInfo> find_stage(const std::vector<StageInfo>& stages, const std::string& label) {
  const auto found =
      std::find_if(stages.begin(), stages.end(), [&](const auto& s) { return s.label() == label; });
  return found == stages.end() ? std::nullopt : std::optional<StageInfo>(*found);
}

std::vector<std::string> labels(const std::vector<StageInfo>& stages) {
  std::vector<std::string> names;
  for (const StageInfo& stage : stages) names.push_back(stage.label());
  return names;
}

// The stage of that label; imports run only when it is not one of them.
StageInfo require_stage(Session& session, const std::string& label) {
  const bool is_complete = session.add_imports();
  if (const auto stage = find_stage(session.engine().stages(), label)) return *stage;
  if (!session.run() || !is_complete) return {};
  session.add_grafts();
  const auto stages = session.engine().stages();
  if (const auto stage = find_stage(stages, label)) return *stage;
  throw Error(ExitCode::Usage,
              fmt::format("no stage \"{}\"{}", printable(label), nearest_hint(label, labels(stages))));
}
}  // namespace

ExitCode stage_run_command(const CommandLine& line, Console& console) {
  Session session(line, only_recipe(line), console);
  session.run_for(require_stage(session, line.stage).writes);
  session.tell_trouble();
  const ExitCode code = exit_code(session.failure());
  if (line.json) {
    const json document = {{"stages", to_json(session.engine().results())},
                           {"exit_code", static_cast<int>(code)}};
    print_data(document.dump(2, ' ', false, json::error_handler_t::replace));
  }
  return code;
}

ExitCode stage_list_command(const CommandLine& line, Console& console) {
  Session session(line, only_recipe(line), console);
  if (session.import()) session.add_grafts();
  session.tell_trouble();
  const std::vector<StageInfo> stages = session.engine().stages();
  json list = json::array();
  for (const StageInfo& stage : stages)
    list.push_back({{"stage", stage.label()}, {"reads", stage.reads}, {"writes", stage.writes}});
  const ExitCode code = exit_code(session.failure());
  const json document = {{"stages", std::move(list)}, {"exit_code", static_cast<int>(code)}};
  if (line.json) print_data(document.dump(2, ' ', false, json::error_handler_t::replace));
  for (const std::string& label : labels(stages))
    if (!line.json) print_data(printable(label));
  return code;
}

}  // namespace skinforge
