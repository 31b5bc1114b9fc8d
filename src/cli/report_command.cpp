#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/planning.h"
#include "cli/recipe_tasks.h"
#include "cli/report_page.h"
#include "pipeline/publish.h"
#include "recipe/recipe_files.h"
#include "stages/build.h"
#include "stages/expect_stage.h"

namespace skinforge {
namespace fs = std::filesystem;

namespace {
// The character itself must have been built; only what tells of it may have to run.
void expect_built(const RecipePlan& plan, const std::string& recipe) {
  for (const StagePlan& stage : plan.stages)
    if (stage.state != PlanState::Hit && !is_of_report(stage.info))
      throw Error(ExitCode::BadInput,
                  fmt::format("{}: not in the cache: stage {} ({}); skinforge build makes it", recipe,
                              stage.info.label(), stage.reason));
}

std::vector<OutputFile> report_files(Session& session, ReportLevel level) {
  std::vector<OutputFile> files = outputs(session.recipe(), session.engine(), level);
  const auto is_of_character = [](const OutputFile& file) {
    return file.name != "report.json" && !file.name.starts_with("pictures/");
  };
  std::erase_if(files, is_of_character);
  return files;
}
}  // namespace

ExitCode report_command(const CommandLine& line, Console& console) {
  if (line.report == ReportLevel::None)
    throw Error(ExitCode::Usage, "--report none: there is nothing to write; json or full");
  Session session(line, only_recipe(line), console);
  const Recipe& recipe = session.recipe();
  expect_built(plan_recipe(session), line.recipes.front());
  const std::vector<OutputFile> files = report_files(session, line.report);
  const ArtifactNames names;
  std::vector<std::string> wanted{names.glb()};
  for (const OutputFile& file : files) wanted.push_back(file.artifact);
  if (line.report == ReportLevel::Full) wanted.push_back(names.view());
  const bool is_ok = session.run_for(wanted);
  session.tell_trouble();
  if (!is_ok) return exit_code(session.failure());
  const fs::path folder = line.out.empty() ? fs::path("out") / recipe.name : fs::path(line.out);
  publish(session.engine(), files, folder, all_files(recipe));
  write_run_files(session, line.report, folder, true);
  const char* last = line.report == ReportLevel::Full ? "report.html" : "report.json";
  console.info((folder / last).string());
  if (line.json) {
    const Bytes report = session.engine().get<Bytes>(names.report());
    print_data(std::string(reinterpret_cast<const char*>(report.data()), report.size()));
  }
  return ExitCode::Ok;
}

}  // namespace skinforge
