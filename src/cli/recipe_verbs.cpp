#include "cli/verb_tree.h"

namespace skinforge {

void VerbTree::add_recipe_verbs() {
  CLI::App* build = add_verb(&app, "build", "Make the characters that recipes describe", Verb::Build);
  add_recipes(build);
  build->add_option("-o,--out", line.out, "Output folder; of several recipes, each gets a folder in it")
      ->type_name("DIR")
      ->default_str("out/<name>")
      ->group("Output");
  add_report_option(build);
  build->add_flag(
      "--preview", line.preview,
      "Parts cut, placed, skinned and animated side by side, not joined: NAME-preview.glb in no time");
  build
      ->add_flag("--accept", line.accept,
                 "Take the result as the golden of its recipe (expect.golden), with a note of what changed")
      ->excludes("--preview")
      ->group("Output");
  build
      ->add_flag("-k,--keep-going", line.keep_going, "Go on with the other recipes when one fails (status 6)")
      ->group("Recipes");
  build->add_flag("--fail-fast", line.fail_fast, "Stop at the first recipe that fails (default)")
      ->excludes("--keep-going")
      ->group("Recipes");
  build
      ->add_flag("--retry-failed", line.retry_failed,
                 "Run stages again that failed before with the same inputs and parameters")
      ->group("Recipes");
  build
      ->add_flag(
          "--verify", line.verify,
          "Run stages whose results are in the cache, too, and fail (status 7) where one gives other bytes")
      ->group("Cache and speed");
  build
      ->add_option("--memory", line.memory_gb,
                   "Start no stage beside another while the program holds more than this")
      ->check(CLI::Range(0.0, 1e6).description(""))
      ->type_name("GB")
      ->default_str("any")
      ->group("Cache and speed");
  build->add_option("--events", line.events, "Write what happens as it happens, one JSON object a line")
      ->type_name("FILE")
      ->group("CI");
  build->add_option("--junit", line.junit, "Write the verdicts as JUnit XML")->type_name("FILE")->group("CI");
  build->add_option("--sarif", line.sarif, "Write errors and warnings as SARIF 2.1.0")
      ->type_name("FILE")
      ->group("CI");
  build->add_option("--summary", line.summary, "Write a summary as Markdown")->type_name("FILE")->group("CI");
  add_work_options(build);

  CLI::App* check =
      add_verb(&app, "check", "Check recipes: keys, files, joints, clips, parts left behind", Verb::Check);
  add_recipes(check);
  add_work_options(check);

  CLI::App* plan = add_verb(&app, "plan", "Say which stages a build would run, and why", Verb::Plan);
  add_recipes(plan);
  add_report_option(plan);
  add_work_options(plan);

  CLI::App* graph = add_verb(&app, "graph", "Print which stage needs which, as dot or JSON", Verb::Graph);
  add_recipe(graph);
  graph->add_option("--format", line.format, "dot (for Graphviz) or json")
      ->check(CLI::IsMember({"dot", "json"}).description(""))
      ->type_name("FORMAT")
      ->default_str("dot")
      ->group("Output");
  add_report_option(graph);
  add_work_options(graph);

  CLI::App* expand =
      add_verb(&app, "expand", "Print the recipe with everything settled, and where each value comes from",
               Verb::Expand);
  add_recipes(expand);

  CLI::App* migrate =
      add_verb(&app, "migrate", "Rewrite recipes of older versions, and say what changed", Verb::Migrate);
  migrate->add_option("RECIPE", line.recipes, "Recipe files")->required()->type_name("");
  migrate->add_flag("--check", line.only_check, "Write nothing; status 5 when something would change");

  CLI::App* again =
      add_verb(&app, "report", "Write the report of a build again, from what is in the cache", Verb::Report);
  add_recipe(again);
  again->add_option("-o,--out", line.out, "Output folder")
      ->type_name("DIR")
      ->default_str("out/<name>")
      ->group("Output");
  add_report_option(again);
  add_work_options(again);

  CLI::App* explain =
      add_verb(&app, "explain", "Say what changed since an earlier run, down to the line of the recipe",
               Verb::Explain);
  add_recipe(explain);
  explain->add_option("STAGE", line.stage, "One stage and what led to it; without it, all that changed")
      ->type_name("");
  explain->add_option("--against", line.against, "Run to compare with, by its id")
      ->type_name("RUN")
      ->default_str("the last; if nothing changed since, the one before");
  add_report_option(explain);
  add_work_options(explain);
}

void VerbTree::add_stage_verbs() {
  CLI::App* stage = add_group("stage", "List the stages of a recipe, or run one of them");
  CLI::App* run = add_verb(stage, "run", "Run one stage and what it needs, into the cache", Verb::StageRun);
  add_recipe(run);
  run->add_option("STAGE", line.stage, "Name as `stage list` prints it, e.g. \"import horse\"")
      ->required()
      ->type_name("");
  add_report_option(run);
  add_work_options(run);
  CLI::App* list = add_verb(stage, "list", "Print the names of all stages", Verb::StageList);
  add_recipe(list);
  add_report_option(list);
  add_work_options(list);
}

}  // namespace skinforge
