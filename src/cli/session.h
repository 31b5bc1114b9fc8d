#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/command_line.h"
#include "cli/console.h"
#include "cli/progress.h"
#include "pipeline/engine.h"
#include "recipe/resolve.h"
#include "report/timings.h"

namespace skinforge {

/// One recipe on its way through an engine, with cache and progress as the command line wants them.
class Session {
 public:
  /// Reads the recipe. `events` and `share` (with other sessions) may be null. Throws Error like
  /// `load_recipe`. Throws Error (Usage) also for an input that --inputs-under forbids; nothing has been read
  /// of it then.
  Session(const CommandLine& line, const ResolvedRecipe& recipe, Console& console,
          RecipeEvents* events = nullptr, WorkShare* share = nullptr);

  const Recipe& recipe() const { return recipe_; }
  Engine& engine() { return engine_; }

  /// Adds the imports; those of recipes used as inputs run, since what follows from them must be known. False
  /// when one failed.
  bool add_imports();
  /// The same, and runs them all.
  bool import();
  /// Adds the imports and runs nothing: what is not in the cache stays unknown. Whether the grafts can be
  /// added.
  bool plan_import();
  /// Adds everything behind the imports, which must have run well or be hits.
  void add_grafts();
  /// Runs what was added, or what these artifacts need. False when something failed.
  bool run();
  bool run_for(const std::vector<std::string>& artifacts);

  /// Runs of this recipe that the cache knows, the last one first.
  std::vector<RunRecord> runs();

  /// Seconds that stages took in the last run of this recipe, by label; those whose record is lost are left
  /// out.
  std::map<std::string, double> last_seconds();
  /// Adds this build to what the cache knows of its use.
  void note_usage();

  /// What each stage cost when it ran, which may have been in an earlier build.
  Timings timings() const;

  /// The first stage that failed; none when all is well.
  std::optional<StageResult> failure() const;
  /// Why a stage failed, with its place in the recipe where it has one: "centaur.json:12:9: /inputs/horse:
  /// ...".
  std::string message_of(const StageResult& stage) const;
  /// Says the errors of failed stages and the cache's warnings.
  void tell_trouble();

 private:
  void expect_inputs_under(const std::vector<std::string>& folders) const;

  const CommandLine& line_;
  Console& console_;
  Recipe recipe_;
  std::string name_;  ///< of its runs in the cache
  FileDigests digests_;
  DiskStore store_;
  Cache cache_;
  Progress progress_;
  Engine engine_;
};

/// Names the runs of a recipe in the cache, wherever the command is called from.
std::string session_name(const ResolvedRecipe& recipe);

/// "hit", "ran", "failed", "skipped".
const char* status_name(StageStatus status);

/// The setting that names the file which a stage reads, "/inputs/horse"; none for a stage that reads no file.
std::optional<std::string> setting_of(const StageResult& stage);

/// Exit status of a session whose first failure is `failure`.
ExitCode exit_code(const std::optional<StageResult>& failure);

/// Stages, issues and errors of a session for --json.
nlohmann::json to_json(const std::vector<StageResult>& results);
nlohmann::json to_json(const std::vector<Issue>& issues);

}  // namespace skinforge
