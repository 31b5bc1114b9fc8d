#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <set>

#include "base/text.h"
#include "cli/commands.h"
#include "cli/planning.h"
#include "cli/recipe_tasks.h"

namespace skinforge {
using nlohmann::json;

namespace {
// A stage with what changed about it.
struct Explained {
  StagePlan plan;
  std::vector<KeyChange> changes;
};

std::string ids_of(const std::vector<RunRecord>& runs) {
  std::vector<std::string> ids;
  for (const RunRecord& run : runs) ids.push_back(run.id());
  return fmt::format("{}", fmt::join(ids, ", "));
}

const RunRecord& find_run(const std::vector<RunRecord>& runs, const std::string& id,
                          const std::string& recipe) {
  for (const RunRecord& run : runs)
    if (run.id().starts_with(id)) return run;
  throw Error(ExitCode::Usage, runs.empty() ? fmt::format("{}: no run of this recipe is in the cache", recipe)
                                            : fmt::format("{}: no run \"{}\"; there are {} (newest first)",
                                                          recipe, printable(id), ids_of(runs)));
}

bool has_changes(const std::vector<Explained>& stages) {
  return std::any_of(stages.begin(), stages.end(), [](const Explained& s) { return !s.changes.empty(); });
}

std::vector<Explained> changes_since(Session& session, const std::vector<StagePlan>& plans,
                                     const RunRecord& run) {
  auto changes = session.engine().changes_since(run);
  std::vector<Explained> stages;
  for (std::size_t i = 0; i < plans.size(); ++i) stages.push_back({plans[i], std::move(changes[i])});
  return stages;
}

const Explained* maker_of(const std::vector<Explained>& stages, const std::string& artifact) {
  for (const Explained& stage : stages)
    for (const std::string& made : stage.plan.info.writes)
      if (made == artifact) return &stage;
  return nullptr;
}

// The stage of that label and, through changed inputs, all that led to its changes.
std::set<std::string> causes_of(const std::vector<Explained>& stages, const Explained& stage) {
  std::set<std::string> labels;
  std::vector<const Explained*> open{&stage};
  while (!open.empty()) {
    const Explained& next = *open.back();
    open.pop_back();
    if (!labels.insert(next.plan.info.label()).second) continue;
    for (const KeyChange& change : next.changes)
      if (const Explained* maker = maker_of(stages, change.name)) open.push_back(maker);
  }
  return labels;
}

const Explained& require_stage(const std::vector<Explained>& stages, const std::string& label,
                               bool is_complete) {
  std::vector<std::string> labels;
  for (const Explained& stage : stages) {
    if (stage.plan.info.label() == label) return stage;
    labels.push_back(stage.plan.info.label());
  }
  throw Error(ExitCode::Usage,
              fmt::format("no stage \"{}\"{}{}", printable(label), nearest_hint(label, labels),
                          is_complete ? "" : "; those behind the imports are known once these have run"));
}

std::string line_of(const KeyChange& change, const std::vector<Explained>& stages, const Recipe& recipe) {
  const Explained* maker = maker_of(stages, change.name);
  return sentence(change, recipe) + (maker ? ", made by " + printable(maker->plan.info.label()) : "");
}

std::string text_of(const std::vector<Explained>& stages, const std::set<std::string>& wanted,
                    const Recipe& recipe) {
  std::string text;
  for (const Explained& stage : stages) {
    if (!wanted.contains(stage.plan.info.label())) continue;
    text += fmt::format("{:<5} {}\n", state_name(stage.plan.state), printable(stage.plan.info.label()));
    if (stage.changes.empty()) text += "        nothing changed\n";
    for (const KeyChange& change : stage.changes) text += "        " + line_of(change, stages, recipe) + "\n";
  }
  return text;
}

json to_json(const std::vector<Explained>& stages, const std::set<std::string>& wanted,
             const Recipe& recipe) {
  json list = json::array();
  for (const Explained& stage : stages) {
    if (!wanted.contains(stage.plan.info.label())) continue;
    json changes = to_json(stage.changes, recipe);
    for (std::size_t i = 0; i < stage.changes.size(); ++i)
      if (const Explained* maker = maker_of(stages, stage.changes[i].name))
        changes[i]["made_by"] = maker->plan.info.label();
    list.push_back({{"stage", stage.plan.info.label()},
                    {"state", state_name(stage.plan.state)},
                    {"changes", std::move(changes)}});
  }
  return list;
}
}  // namespace

ExitCode explain_command(const CommandLine& line, Console& console) {
  const std::string& path = line.recipes.front();
  Session session(line, only_recipe(line), console);
  const RecipePlan plan = plan_recipe(session);
  session.tell_trouble();
  const std::vector<RunRecord> runs = session.runs();
  RunRecord against;
  if (!line.against.empty()) against = find_run(runs, line.against, path);
  if (line.against.empty() && !runs.empty()) against = runs.front();
  std::vector<Explained> stages = changes_since(session, plan.stages, against);
  if (line.against.empty() && !has_changes(stages) && runs.size() > 1) {  // up to date: why did it run last?
    against = runs[1];
    stages = changes_since(session, plan.stages, against);
  }

  std::set<std::string> wanted;
  if (!line.stage.empty()) wanted = causes_of(stages, require_stage(stages, line.stage, plan.is_complete));
  for (const Explained& stage : stages)
    if (line.stage.empty() && !stage.changes.empty()) wanted.insert(stage.plan.info.label());

  const std::string since = against.stages.empty() ? "" : against.id();
  if (line.json) {
    const json document = {{"recipe", path},
                           {"name", session.recipe().name},
                           {"against", since},
                           {"is_complete", plan.is_complete},
                           {"stages", to_json(stages, wanted, session.recipe())},
                           {"exit_code", 0}};
    print_data(document.dump(2, ' ', false, json::error_handler_t::replace));
    return ExitCode::Ok;
  }
  const std::string head = since.empty() ? "no earlier run" : "against run " + since;
  print_data(fmt::format("{}, {}\n{}", session.recipe().name, head,
                         wanted.empty() ? "nothing changed\n" : text_of(stages, wanted, session.recipe())));
  return ExitCode::Ok;
}

}  // namespace skinforge
