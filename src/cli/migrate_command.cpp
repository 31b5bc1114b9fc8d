#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "base/text.h"
#include "cli/commands.h"
#include "pipeline/publish.h"
#include "recipe/migrate.h"
#include "recipe/recipe_file.h"
#include "report/build_verdict.h"

namespace skinforge {
using nlohmann::json;

namespace {
// One recipe; with `only_check` nothing is written, and a change is a difference.
ExitCode migrate_file(const std::string& file, bool only_check, Console& console, json& result) {
  const Migration migration = migrate_recipe(read_recipe_text(file), file);
  result["changes"] = migration.changes;
  for (const std::string& change : migration.changes) console.info(printable(change));
  if (migration.changes.empty()) console.info(printable(file) + ": nothing to change");
  if (migration.changes.empty()) return ExitCode::Ok;
  if (only_check) return ExitCode::Different;
  write_output(file, migration.text);
  return ExitCode::Ok;
}
}  // namespace

ExitCode migrate_command(const CommandLine& line, Console& console) {
  json list = json::array();
  ExitCode worst = ExitCode::Ok;
  for (const std::string& file : line.recipes) {
    json result = {{"recipe", file}, {"changes", json::array()}};
    ExitCode code = ExitCode::Ok;
    try {
      code = migrate_file(file, line.only_check, console, result);
    } catch (const Error& error) {
      code = error.code();
      result["error"] = error.what();
      console.error(printable(error.what()));
    }
    if (worst == ExitCode::Ok || worst == ExitCode::Different) worst = code == ExitCode::Ok ? worst : code;
    result["exit_code"] = static_cast<int>(code);
    result["id"] = rule_name(code);
    list.push_back(std::move(result));
  }
  const json document = {{"recipes", std::move(list)}, {"exit_code", static_cast<int>(worst)}};
  if (line.json) print_data(document.dump(2, ' ', false, json::error_handler_t::replace));
  return worst;
}

}  // namespace skinforge
