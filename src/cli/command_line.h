#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/limits.h"
#include "cli/console.h"
#include "recipe/resolve.h"

namespace skinforge {

enum class ReportLevel : std::uint8_t;  // stages/build.h

enum class Verb {
  Build,
  Check,
  Plan,
  Explain,
  Expand,
  Migrate,
  Report,
  Inspect,
  Diff,
  Verify,
  Validate,
  Repair,
  Graph,
  Doctor,
  Completion,
  Bind,
  Deform,
  CompareSkinning,
  StageRun,
  StageList,
  CacheStats,
  CacheGc,
  CachePin,
  CacheUnpin,
  CacheVerify,
  CacheClear,
  CachePath,
  Schema,
  Version,
  Help
};

/// What the verbs of the skinning toolkit are told. The model itself is CommandLine::file.
struct SkinningRequest {
  std::string skeleton;                    ///< .tgf or a model; empty: the model has its skin
  std::string handles = "rule";            ///< or "groups", "skin", or a file
  std::string label_colors;                ///< .json: joints and their colours in a painted image
  std::string bind_method = "harmonic";    ///< or "heat"
  std::vector<std::string> poses;          ///< .dmat files
  std::vector<std::string> examples;       ///< shape and pose in turn
  bool with_rest = true;                   ///< the rest pose is an example, too
  std::string kernel = "linear";           ///< or "gaussian"; of examples
  std::vector<std::string> driver_joints;  ///< by which poses are compared; empty: all but roots
  std::string deform_method = "lbs";       ///< deform
  std::string clip;                        ///< empty: the first
  std::string format = "obj";              ///< or "ply"; deform
  std::string joint;                       ///< whose weights bind draws; empty: the one with most vertices
  std::size_t frames = 24;
  std::size_t influences = 4;  ///< bind
  double rate_hz = 30;         ///< of .dmat files
};

/// What `diff` is told.
struct DiffRequest {
  std::string a, b;                     ///< model files; A is the reference
  std::vector<std::string> thresholds;  ///< "animation=0.05%"
  std::string junit, sarif, html;       ///< files; empty: none
  std::string pictures;                 ///< folder; empty: none are written
  bool without_pictures = false;        ///< draw none
  bool accept = false;                  ///< B becomes the reference
};

/// What the person asked for. Defaults are those that the help prints.
struct CommandLine {
  Verb verb = Verb::Help;
  bool json = false;
  Verbosity verbosity = Verbosity::Normal;
  std::vector<std::string> recipes;  ///< build, check, plan: one or more; stage: one
  RecipeChoice choice;               ///< --set, --only, --inputs-under
  std::string shard;                 ///< "2/5"; empty: all
  std::string stage;                 ///< label; stage run, explain
  std::string against;               ///< explain: id of a run; empty: the last, or the one before
  std::string file;                  ///< inspect, verify, validate, repair, bind, deform, compare-skinning
  SkinningRequest skinning;
  DiffRequest diff;
  std::string out;    ///< empty: out/<name>
  std::string cache;  ///< folder, settled: --cache, $SKINFORGE_CACHE or .skinforge/cache
  std::size_t jobs = 1;
  ReportLevel report{};           ///< as the parser sets it: Full unless asked otherwise
  std::string schema = "recipe";  ///< or "report"
  bool keep_going = false;
  bool fail_fast = false;             ///< as without keep_going; said aloud
  bool retry_failed = false;          ///< run again what failed before with the same key
  bool verify = false;                ///< build: run what the cache knows, too, and compare
  std::string junit, sarif, summary;  ///< build: files; empty: none
  double max_age_days = 0;            ///< cache gc; 0: any
  double memory_gb = 0;               ///< build; 0: any
  double max_size_gb = 0;             ///< cache gc; 0: any
  Limits limits;                      ///< --limit
  bool preview = false;               ///< build: parts side by side, at once
  bool only_check = false;            ///< migrate: write nothing
  bool accept = false;                ///< build: the result becomes the golden
  std::string events;                 ///< build: file for what happens; empty: none
  bool strict = false;                ///< validate: warnings count, too
  bool without_khronos = false;       ///< validate: own rules only
  std::size_t influences = 0;         ///< repair: 4 or 8; 0: 8 where the model has more than 4
  std::string format = "dot";         ///< graph: or "json"
  std::string help;                   ///< text for Verb::Help
};

/// Reads the arguments (without the program's name). Throws Error (Usage) for everything that is wrong, with
/// the nearest verb or option.
CommandLine parse_command_line(const std::vector<std::string>& arguments);

}  // namespace skinforge
