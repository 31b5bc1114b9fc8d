#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "base/text.h"
#include "cli/commands.h"
#include "cli/recipe_tasks.h"

namespace skinforge {
using nlohmann::json;

namespace {
json expanded_json(const RecipeTask& task, const Recipe& recipe) {
  json origins = json::object();
  for (const auto& [pointer, text] : recipe.values) origins[pointer] = recipe.where(pointer);
  return {{"recipe", task.recipe},
          {"variant", recipe.variant},
          {"name", recipe.name},
          {"expanded", json::parse(plain_json(task.resolved.root))},
          {"origins", std::move(origins)}};
}
}  // namespace

ExitCode expand_command(const CommandLine& line, Console& console) {
  json list = json::array();
  ExitCode worst = ExitCode::Ok;
  for (const RecipeTask& task : recipe_tasks(line)) {
    json result = {
        {"recipe", task.recipe}, {"error", task.error}, {"exit_code", static_cast<int>(task.code)}};
    ExitCode code = task.code;
    try {
      if (code != ExitCode::Ok) throw Error(code, task.error);
      const Recipe recipe = read_resolved(task.resolved);  // what it says must hold, too
      result = expanded_json(task, recipe);
      if (!line.json) print_data("// " + printable(task.label()) + "\n" + expanded_text(task.resolved.root));
    } catch (const Error& error) {
      code = error.code();
      console.error(printable(error.what()));
      result["error"] = error.what();
      result["exit_code"] = static_cast<int>(code);
    }
    if (worst == ExitCode::Ok) worst = code;
    list.push_back(std::move(result));
  }
  const json document = {{"recipes", std::move(list)}, {"exit_code", static_cast<int>(worst)}};
  if (line.json) print_data(document.dump(2, ' ', false, json::error_handler_t::replace));
  return worst;
}

}  // namespace skinforge
