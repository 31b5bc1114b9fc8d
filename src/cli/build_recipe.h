#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "cli/event_stream.h"
#include "cli/recipe_tasks.h"
#include "cli/session.h"
#include "pipeline/publish.h"
#include "pipeline/work_share.h"
#include "report/build_verdict.h"

namespace skinforge {

/// How the build of one recipe went.
struct Outcome {
  std::string recipe;
  std::string variant;
  std::string name;
  std::filesystem::path folder;
  ExitCode code = ExitCode::Ok;
  std::string error;
  double seconds = 0;
  std::vector<StageResult> stages;
  std::vector<PublishedFile> files;
};

/// Builds one recipe and writes its files, and says so. Does not throw: what went wrong is in the outcome,
/// and said. `share`: with other builds. `is_alone`: the output folder is the one of the command line, not
/// one in it.
Outcome build_recipe(const CommandLine& line, const RecipeTask& task, Console& console, EventStream& events,
                     WorkShare& share, bool is_alone);

/// For --json.
nlohmann::json to_json(const Outcome& outcome);
/// For JUnit, SARIF and the like.
BuildVerdict verdict_of(const Outcome& outcome);

}  // namespace skinforge
