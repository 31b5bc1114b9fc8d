#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <string>
#include <vector>

#include "cli/command_line.h"

namespace skinforge {

/// The verbs with their options as CLI11 sees them, and what these fill. One object because CLI11 keeps
/// pointers. For command_line.cpp and the *_verbs.cpp, one file for each group of verbs.
class VerbTree {
 public:
  VerbTree();
  VerbTree(const VerbTree&) = delete;
  VerbTree& operator=(const VerbTree&) = delete;

  CLI::App app{"Grafts parts of rigged, animated characters into one.", "skinforge"};
  CommandLine line;
  std::map<const CLI::App*, Verb> verbs;
  // Words that are read further once all are there.
  std::string topic;
  std::string shell;
  std::string recipe;
  std::string report = "full";
  std::vector<std::string> raised;  ///< limits
  bool quiet = false;
  bool verbose = false;

 private:
  CLI::App* add_verb(CLI::App* parent, const std::string& name, const std::string& what, Verb verb);
  CLI::App* add_group(const std::string& name, const std::string& what);
  void add_talk_flags(CLI::App* verb);  ///< before the verb or behind it

  void add_recipes(CLI::App* verb);
  void add_recipe(CLI::App* verb);
  void add_choice_options(CLI::App* verb);
  void add_report_option(CLI::App* verb);
  void add_cache_option(CLI::App* verb);
  void add_jobs_option(CLI::App* verb);
  void add_work_options(CLI::App* verb);  ///< cache and jobs

  void add_recipe_verbs();
  void add_stage_verbs();
  void add_skinning_verbs();
  void add_rig_options(CLI::App* verb);
  void add_frame_options(CLI::App* verb);
  void add_cache_verbs();
  void add_model_verbs();
  void add_diff_verb();
  void add_repair_verbs();
  void add_help_verbs();
};

}  // namespace skinforge
