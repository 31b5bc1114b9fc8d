#include "cli/verb_tree.h"

#include <cstdlib>
#include <thread>

#include "base/version.h"

namespace skinforge {

namespace {
constexpr std::size_t kMaxJobs = 1024;  // ours: far above any machine it runs on

std::string default_cache() {
  const char* folder = std::getenv("SKINFORGE_CACHE");
  return folder && *folder ? folder : ".skinforge/cache";
}
}  // namespace

VerbTree::VerbTree() {
  app.set_help_all_flag("--help-all", "Print the help of every command");
  app.set_version_flag("--version", std::string("skinforge ") + kVersion);
  app.require_subcommand(0, 1);
  add_talk_flags(&app);
  app.footer(
      "Exit status: 0 ok, 1 a stage failed, 2 usage or recipe error, 3 input missing or corrupt,\n"
      "4 validation failed, 5 models differ, 6 some recipes failed (--keep-going),\n"
      "70 internal error, 130/143 ended by a signal. help status, environment, recipe, caching, ci says "
      "more.");
  line.jobs = std::max(1U, std::thread::hardware_concurrency());
  line.cache = default_cache();
  add_recipe_verbs();
  add_skinning_verbs();
  add_stage_verbs();
  add_cache_verbs();
  add_model_verbs();
  add_help_verbs();
}

CLI::App* VerbTree::add_verb(CLI::App* parent, const std::string& name, const std::string& what, Verb verb) {
  CLI::App* added = parent->add_subcommand(name, what);
  added->allow_extras();
  add_talk_flags(added);
  verbs[added] = verb;
  return added;
}

CLI::App* VerbTree::add_group(const std::string& name, const std::string& what) {
  CLI::App* group = app.add_subcommand(name, what);
  group->allow_extras();
  group->require_subcommand(0, 1);
  add_talk_flags(group);
  return group;
}

void VerbTree::add_talk_flags(CLI::App* verb) {
  verb->add_flag("--json", line.json, "Print the result as JSON on stdout");
  verb->add_flag("-q,--quiet", quiet, "Say warnings and errors only");
  verb->add_flag("-v,--verbose", verbose, "Say more");
  verb->add_option("--limit", raised,
                   "Let inputs ask for more (or less): vertices=20M; help limits lists them")
      ->allow_extra_args(false)
      ->type_name("NAME=VALUE");
}

void VerbTree::add_recipes(CLI::App* verb) {
  verb->add_option("RECIPE", line.recipes, "Recipe files (.json, .jsonc, .yaml, .yml), or folders of them")
      ->required()
      ->type_name("");
  add_choice_options(verb);
  verb->add_option("--shard", line.shard, "Only the I-th of N equal shares, for several machines")
      ->type_name("I/N")
      ->group("Recipes");
}

void VerbTree::add_recipe(CLI::App* verb) {
  verb->add_option("RECIPE", recipe, "Recipe file")->required()->type_name("");
  add_choice_options(verb);
}

void VerbTree::add_choice_options(CLI::App* verb) {
  verb->add_option("--set", line.choice.set,
                   "Set a variable of the recipe, or with a leading / any property: /output/influences=8")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false)
      ->group("Recipes");
  verb->add_option("--inputs-under", line.choice.inputs_under,
                   "Refuse recipes that name files elsewhere (models, extends, include), links followed")
      ->type_name("DIR")
      ->allow_extra_args(false)
      ->group("Recipes");
  verb->add_option("--only", line.choice.only, "Only the cells of the matrix with this value")
      ->type_name("AXIS=VALUE")
      ->allow_extra_args(false)
      ->group("Recipes");
}

void VerbTree::add_report_option(CLI::App* verb) {
  verb->add_option("--report", report,
                   "What to say about the result: none, json, or full (with pictures and report.html)")
      ->check(CLI::IsMember({"none", "json", "full"}).description(""))
      ->type_name("LEVEL")
      ->default_str("full")
      ->group("Output");
}

void VerbTree::add_cache_option(CLI::App* verb) {
  verb->add_option("--cache", line.cache, "Folder of the cache")
      ->type_name("DIR")
      ->default_str("$SKINFORGE_CACHE, else .skinforge/cache")
      ->group("Cache and speed");
}

void VerbTree::add_jobs_option(CLI::App* verb) {
  verb->add_option("-j,--jobs", line.jobs, "Threads; the result is the same for any number")
      ->check(CLI::Range(std::size_t{1}, kMaxJobs))
      ->type_name("N")
      ->default_str("one per core")
      ->group("Cache and speed");
}

void VerbTree::add_work_options(CLI::App* verb) {
  add_cache_option(verb);
  add_jobs_option(verb);
}

}  // namespace skinforge
