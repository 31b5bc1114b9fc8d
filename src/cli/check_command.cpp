#include <fmt/core.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/text.h"
#include "cli/commands.h"
#include "cli/recipe_tasks.h"
#include "cli/session.h"
#include "report/build_verdict.h"
#include "stages/build.h"

namespace skinforge {
using nlohmann::json;

namespace {
// A golden that is not there yet is no mistake, but a build will say so at its end.
void tell_missing_golden(const Recipe& recipe, Console& console) {
  if (recipe.golden && !std::filesystem::exists(recipe.golden->file.resolved))
    console.issue({"golden-missing", Severity::Warning, recipe.place("/expect/golden"),
                   printable(recipe.golden->file.text) + " is not there yet; build --accept makes it"});
}

// The recipe, its files, its clips, every joint (grafting the skeletons meets them all), and what the cuts
// leave of the surfaces.
ExitCode check_recipe(const CommandLine& line, const RecipeTask& task, Console& console, json& result) {
  if (task.code != ExitCode::Ok) throw Error(task.code, task.error);
  Session session(line, task.resolved, console);
  result["name"] = session.recipe().name;
  if (session.import()) {
    session.add_grafts();
    session.run_for({ArtifactNames().graft(), ArtifactNames().selection()});
  }
  session.tell_trouble();
  tell_missing_golden(session.recipe(), console);
  const auto failure = session.failure();
  if (failure) result["error"] = session.message_of(*failure);
  result["stages"] = to_json(session.engine().results());
  return exit_code(failure);
}
}  // namespace

ExitCode check_command(const CommandLine& line, Console& console) {
  json list = json::array();
  ExitCode worst = ExitCode::Ok;
  for (const RecipeTask& task : recipe_tasks(line)) {
    json result = {{"recipe", task.recipe}, {"variant", task.resolved.variant}};
    ExitCode code = ExitCode::Ok;
    try {
      code = check_recipe(line, task, console, result);
    } catch (const Error& error) {
      code = error.code();
      result["error"] = error.what();
      console.error(printable(error.what()));
    }
    if (code == ExitCode::Ok) console.info(task.label() + ": ok");
    if (worst == ExitCode::Ok) worst = code;
    result["exit_code"] = static_cast<int>(code);
    result["id"] = rule_name(code);
    list.push_back(std::move(result));
  }
  if (line.json) {
    const json document = {{"recipes", std::move(list)}, {"exit_code", static_cast<int>(worst)}};
    print_data(document.dump(2, ' ', false, json::error_handler_t::replace));
  }
  return worst;
}

}  // namespace skinforge
