#include "cli/command_line.h"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <map>
#include <thread>

#include "base/error.h"
#include "base/text.h"
#include "base/version.h"
#include "cli/completion_text.h"
#include "cli/help_topics.h"
#include "stages/build.h"

namespace skinforge {

namespace {
constexpr std::size_t kMaxJobs = 1024;  // ours: far above any machine it runs on

ReportLevel report_level(const std::string& word) {
  if (word == "none") return ReportLevel::None;
  return word == "json" ? ReportLevel::Json : ReportLevel::Full;
}

std::string default_cache() {
  const char* folder = std::getenv("SKINFORGE_CACHE");
  return folder && *folder ? folder : ".skinforge/cache";
}

// The command line as CLI11 sees it. One object because CLI11 keeps pointers to what it fills.
class Parser {
 public:
  Parser() {
    app_.set_help_all_flag("--help-all", "Print the help of every command");
    app_.set_version_flag("--version", std::string("skinforge ") + kVersion);
    app_.require_subcommand(0, 1);
    add_talk_flags(&app_);
    app_.footer(
        "Exit status: 0 ok, 1 a stage failed, 2 usage or recipe error, 3 input missing or corrupt,\n"
        "4 validation failed, 5 models differ, 6 some recipes failed (--keep-going),\n"
        "70 internal error, 130/143 ended by a signal. help status, environment, recipe, caching, ci says "
        "more.");
    line_.jobs = std::max(1U, std::thread::hardware_concurrency());
    line_.cache = default_cache();
    add_recipe_verbs();
    add_skinning_verbs();
    add_stage_verbs();
    add_cache_verbs();
    add_other_verbs();
  }

  CommandLine parse(std::vector<std::string> arguments) {
    std::reverse(arguments.begin(), arguments.end());  // CLI11 takes them from the back
    try {
      app_.parse(arguments);
    } catch (const CLI::CallForHelp&) {
      return help(help_of(chosen(&app_)));
    } catch (const CLI::CallForAllHelp&) {
      return help(app_.help("", CLI::AppFormatMode::All));
    } catch (const CLI::CallForVersion& version) {
      return help(version.what());
    } catch (const CLI::ParseError& error) {
      expect_nothing_left(&app_);
      throw Error(ExitCode::Usage, printable(error.what()) + hint());
    }
    expect_nothing_left(&app_);
    const CLI::App* verb = chosen(&app_);
    if (verb == &app_ || (verb->get_parent() == &app_ && !verbs_.contains(verb)))
      throw Error(ExitCode::Usage, verb == &app_
                                       ? "a command is missing" + hint()
                                       : "\"" + verb->get_name() + "\" needs one of: " + names_below(verb));
    line_.verb = verbs_.at(verb);
    line_.report = report_level(report_);
    if (!recipe_.empty()) line_.recipes = {recipe_};
    if (line_.verb == Verb::Help) line_.help = help_about(topic_);
    for (const std::string& text : raised_) set_limit(line_.limits, text);
    if (line_.verb == Verb::Completion) line_.help = completion_script(shell_, verb_words(&app_, ""));
    line_.verbosity = quiet_ ? Verbosity::Quiet : verbose_ ? Verbosity::Verbose : Verbosity::Normal;
    return line_;
  }

 private:
  static std::string hint() { return "; skinforge help shows what there is"; }

  CommandLine help(const std::string& text) {
    line_.verb = Verb::Help;
    line_.help = text;
    return line_;
  }

  // App::help would go on to the verb that was given.
  static std::string help_of(const CLI::App* app) {
    std::string name = app->get_name();
    for (const CLI::App* parent = app->get_parent(); parent; parent = parent->get_parent())
      name = parent->get_name() + " " + name;
    return app->get_formatter()->make_help(app, name, CLI::AppFormatMode::Normal);
  }

  std::string help_about(const std::string& topic) const {
    if (topic.empty()) return help_of(&app_);
    if (topic == "limits")
      return "What inputs may ask for, as --limit NAME=VALUE changes it:\n" + limit_table();
    for (const CLI::App* verb : app_.get_subcommands(nullptr))
      if (verb->get_name() == topic) return help_of(verb);
    if (const auto text = help_topic(topic)) return *text;
    std::vector<std::string> known = verb_names(&app_), topics = help_topic_names();
    known.insert(known.end(), topics.begin(), topics.end());
    throw Error(ExitCode::Usage,
                fmt::format("unknown command \"{}\"{}", printable(topic), nearest_hint(topic, known)));
  }

  static std::vector<std::string> verb_names(const CLI::App* app) {
    std::vector<std::string> names;
    for (const CLI::App* verb : app->get_subcommands(nullptr)) names.push_back(verb->get_name());
    return names;
  }

  // What shells need to know, of all verbs below `app`.
  static std::vector<VerbWords> verb_words(const CLI::App* app, const std::string& prefix) {
    std::vector<VerbWords> all;
    for (const CLI::App* verb : app->get_subcommands(nullptr)) {
      const std::string name = prefix + verb->get_name();
      if (!verb->get_subcommands(nullptr).empty()) {
        for (VerbWords& below : verb_words(verb, name + " ")) all.push_back(std::move(below));
        continue;
      }
      VerbWords words{name, verb->get_description(), {}};
      for (const CLI::Option* option : verb->get_options())
        if (!option->get_positional() || !option->get_lnames().empty())
          words.options.push_back(option_words(option));
      all.push_back(std::move(words));
    }
    return all;
  }

  static VerbWords::Option option_words(const CLI::Option* option) {
    VerbWords::Option words;
    for (const std::string& name : option->get_lnames()) words.names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) words.names.push_back("-" + name);
    words.what = option->get_description();
    words.takes_value = option->get_items_expected_max() > 0;
    if (const auto choices = choices_.find(words.names.front()); choices != choices_.end())
      words.choices = choices->second;
    return words;
  }

  static std::string names_below(const CLI::App* app) {
    std::string names;
    for (const std::string& name : verb_names(app)) names += (names.empty() ? "" : ", ") + name;
    return names;
  }

  static std::vector<std::string> option_names(const CLI::App* app) {
    std::vector<std::string> names;
    for (const CLI::Option* option : app->get_options())
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    return names;
  }

  // The innermost verb that was given; the app itself when there is none.
  static const CLI::App* chosen(const CLI::App* app) {
    const auto given = app->get_subcommands();
    return given.empty() ? app : chosen(given.front());
  }

  // Words that no verb took: mistyped verbs and options, with the nearest right ones.
  static void expect_nothing_left(const CLI::App* app) {
    const CLI::App* verb = chosen(app);
    for (const std::string& word : app->remaining(true)) {
      if (word.starts_with("-")) {
        const std::string name = word.substr(0, word.find('='));
        throw Error(ExitCode::Usage, fmt::format("unknown option {}{}", printable(name),
                                                 nearest_hint(name, option_names(verb))));
      }
      const auto names = verb_names(verb);
      if (!names.empty())
        throw Error(ExitCode::Usage,
                    fmt::format("unknown command \"{}\"{}", printable(word), nearest_hint(word, names)));
      throw Error(ExitCode::Usage, fmt::format("unexpected argument \"{}\"", printable(word)));
    }
  }

  CLI::App* add_verb(CLI::App* parent, const std::string& name, const std::string& what, Verb verb) {
    CLI::App* app = parent->add_subcommand(name, what);
    app->allow_extras();
    add_talk_flags(app);
    verbs_[app] = verb;
    return app;
  }

  // Before the verb or behind it.
  void add_talk_flags(CLI::App* app) {
    app->add_flag("--json", line_.json, "Print the result as JSON on stdout");
    app->add_flag("-q,--quiet", quiet_, "Say warnings and errors only");
    app->add_flag("-v,--verbose", verbose_, "Say more");
    app->add_option("--limit", raised_,
                    "Let inputs ask for more (or less): vertices=20M; help limits lists them")
        ->allow_extra_args(false)
        ->type_name("NAME=VALUE");
  }

  CLI::App* add_group(const std::string& name, const std::string& what) {
    CLI::App* app = app_.add_subcommand(name, what);
    app->allow_extras();
    app->require_subcommand(0, 1);
    add_talk_flags(app);
    return app;
  }

  void add_cache_option(CLI::App* app) {
    app->add_option("--cache", line_.cache, "Folder of the cache")
        ->type_name("DIR")
        ->default_str("$SKINFORGE_CACHE, else .skinforge/cache")
        ->group("Cache and speed");
  }

  void add_work_options(CLI::App* app) {
    add_cache_option(app);
    add_jobs_option(app);
  }

  void add_jobs_option(CLI::App* app) {
    app->add_option("-j,--jobs", line_.jobs, "Threads; the result is the same for any number")
        ->check(CLI::Range(std::size_t{1}, kMaxJobs))
        ->type_name("N")
        ->default_str("one per core")
        ->group("Cache and speed");
  }

  void add_report_option(CLI::App* app) {
    app->add_option("--report", report_,
                    "What to say about the result: none, json, or full (with pictures and report.html)")
        ->check(CLI::IsMember({"none", "json", "full"}).description(""))
        ->type_name("LEVEL")
        ->default_str("full")
        ->group("Output");
  }

  void add_recipes(CLI::App* app) {
    app->add_option("RECIPE", line_.recipes, "Recipe files (.json, .jsonc, .yaml, .yml), or folders of them")
        ->required()
        ->type_name("");
    add_choice_options(app);
    app->add_option("--shard", line_.shard, "Only the I-th of N equal shares, for several machines")
        ->type_name("I/N")
        ->group("Recipes");
  }

  void add_choice_options(CLI::App* app) {
    app->add_option("--set", line_.choice.set,
                    "Set a variable of the recipe, or with a leading / any property: /output/influences=8")
        ->type_name("NAME=VALUE")
        ->allow_extra_args(false)
        ->group("Recipes");
    app->add_option("--inputs-under", line_.inputs_under,
                    "Refuse recipes with inputs elsewhere, links followed")
        ->type_name("DIR")
        ->allow_extra_args(false)
        ->group("Recipes");
    app->add_option("--only", line_.choice.only, "Only the cells of the matrix with this value")
        ->type_name("AXIS=VALUE")
        ->allow_extra_args(false)
        ->group("Recipes");
  }

  void add_recipe(CLI::App* app) {
    app->add_option("RECIPE", recipe_, "Recipe file")->required()->type_name("");
    add_choice_options(app);
  }

  void add_recipe_verbs() {
    CLI::App* build = add_verb(&app_, "build", "Make the characters that recipes describe", Verb::Build);
    add_recipes(build);
    build->add_option("-o,--out", line_.out, "Output folder; of several recipes, each gets a folder in it")
        ->type_name("DIR")
        ->default_str("out/<name>")
        ->group("Output");
    add_report_option(build);
    build->add_flag(
        "--preview", line_.preview,
        "Parts cut, placed, skinned and animated side by side, not joined: NAME-preview.glb in no time");
    build
        ->add_flag("-k,--keep-going", line_.keep_going,
                   "Go on with the other recipes when one fails (status 6)")
        ->group("Recipes");
    build->add_flag("--fail-fast", line_.fail_fast, "Stop at the first recipe that fails (default)")
        ->excludes("--keep-going")
        ->group("Recipes");
    build
        ->add_flag("--retry-failed", line_.retry_failed,
                   "Run stages again that failed before with the same inputs and parameters")
        ->group("Recipes");
    build
        ->add_option("--memory", line_.memory_gb,
                     "Start no stage beside another while the program holds more than this")
        ->check(CLI::Range(0.0, 1e6).description(""))
        ->type_name("GB")
        ->default_str("any")
        ->group("Cache and speed");
    build->add_option("--events", line_.events, "Write what happens as it happens, one JSON object a line")
        ->type_name("FILE")
        ->group("CI");
    build->add_option("--junit", line_.junit, "Write the verdicts as JUnit XML")
        ->type_name("FILE")
        ->group("CI");
    build->add_option("--sarif", line_.sarif, "Write errors and warnings as SARIF 2.1.0")
        ->type_name("FILE")
        ->group("CI");
    build->add_option("--summary", line_.summary, "Write a summary as Markdown")
        ->type_name("FILE")
        ->group("CI");
    add_work_options(build);

    CLI::App* check =
        add_verb(&app_, "check", "Check recipes: keys, files, joints, clips, parts left behind", Verb::Check);
    add_recipes(check);
    add_work_options(check);

    CLI::App* plan = add_verb(&app_, "plan", "Say which stages a build would run, and why", Verb::Plan);
    add_recipes(plan);
    add_report_option(plan);
    add_work_options(plan);

    CLI::App* graph = add_verb(&app_, "graph", "Print which stage needs which, as dot or JSON", Verb::Graph);
    add_recipe(graph);
    graph->add_option("--format", line_.format, "dot (for Graphviz) or json")
        ->check(CLI::IsMember({"dot", "json"}).description(""))
        ->type_name("FORMAT")
        ->default_str("dot")
        ->group("Output");
    add_report_option(graph);
    add_work_options(graph);

    CLI::App* expand =
        add_verb(&app_, "expand", "Print the recipe with everything settled, and where each value comes from",
                 Verb::Expand);
    add_recipes(expand);

    CLI::App* explain =
        add_verb(&app_, "explain", "Say what changed since an earlier run, down to the line of the recipe",
                 Verb::Explain);
    add_recipe(explain);
    explain->add_option("STAGE", line_.stage, "One stage and what led to it; without it, all that changed")
        ->type_name("");
    explain->add_option("--against", line_.against, "Run to compare with, by its id")
        ->type_name("RUN")
        ->default_str("the last; if nothing changed since, the one before");
    add_report_option(explain);
    add_work_options(explain);
  }

  // What makes a model with a skin of the files that are named.
  void add_rig_options(CLI::App* app) {
    SkinningRequest& request = line_.skinning;
    app->add_option("MODEL", line_.file, "Model: .obj, .off, .glb, .fbx, ...")->required()->type_name("");
    app->add_option("--skeleton", request.skeleton,
                    "Bones: a .tgf file, or a model whose joints and clips to take")
        ->type_name("FILE")
        ->default_str("the model's own")
        ->group("Skin");
    app->add_option("--method", request.bind_method,
                    "How to bind: harmonic (over the surface from handles) or heat (through the inside)")
        ->check(CLI::IsMember({"harmonic", "heat"}).description(""))
        ->type_name("METHOD")
        ->default_str("harmonic")
        ->group("Skin");
    app->add_option("--handles", request.handles,
                    "Vertices that bones hold alone: rule, groups, skin, a .dmat of labels, a .json of "
                    "vertex lists, or a "
                    "painted .png")
        ->type_name("WHAT")
        ->default_str("rule")
        ->group("Skin");
    app->add_option("--label-colors", request.label_colors,
                    "Colours of a painted image by joint, as {\"Head\": \"#ff8000\"}")
        ->type_name("FILE")
        ->group("Skin");
    app->add_option("--poses", request.poses, "Rotations of all bones, a .dmat file each; becomes a clip")
        ->type_name("FILE")
        ->group("Skin");
    app->add_option("--rate", request.rate_hz, "Frames a second of those, 1 to 240")
        ->check(CLI::Range(1.0, 240.0).description(""))
        ->type_name("HZ")
        ->default_str("30")
        ->group("Skin");
    app->add_option("-o,--out", line_.out, "Output folder")
        ->type_name("DIR")
        ->default_str("out/<model>")
        ->group("Output");
  }

  void add_frame_options(CLI::App* app) {
    constexpr std::size_t kMaxFrames = 100000;  // ours: an hour at 30 a second
    SkinningRequest& request = line_.skinning;
    app->add_option("--clip", request.clip, "Clip to play")
        ->type_name("NAME")
        ->default_str("the first")
        ->group("Frames");
    app->add_option("--frames", request.frames, "Frames, evenly over the clip")
        ->check(CLI::Range(std::size_t{1}, kMaxFrames).description(""))
        ->type_name("N")
        ->default_str("24")
        ->group("Frames");
    app->add_option("--example", request.examples,
                    "A shape of the model and its pose, for the context methods")
        ->type_name("SHAPE POSE")
        ->expected(2)
        ->take_all()
        ->group("Examples");
    app->add_flag("!--no-rest", request.with_rest, "Do not take the rest pose as one more example")
        ->group("Examples");
    app->add_option("--kernel", request.kernel, "How examples share between them: linear or gaussian")
        ->check(CLI::IsMember({"linear", "gaussian"}).description(""))
        ->type_name("KERNEL")
        ->default_str("linear")
        ->group("Examples");
    app->add_option("--driver-joint", request.driver_joints,
                    "A joint by whose rotation poses are compared; may be given several times")
        ->type_name("NAME")
        ->default_str("all but roots")
        ->group("Examples");
  }

  void add_skinning_verbs() {
    CLI::App* bind = add_verb(&app_, "bind", "Give a model without a skin bones and weights", Verb::Bind);
    add_rig_options(bind);
    bind->add_option("--influences", line_.skinning.influences, "Joints a vertex follows at most: 4 or 8")
        ->check(CLI::IsMember(std::vector<std::size_t>{4, 8}).description(""))
        ->type_name("N")
        ->default_str("4")
        ->group("Output");
    bind->add_option("--joint", line_.skinning.joint, "Joint whose weights are drawn")
        ->type_name("NAME")
        ->default_str("the one with most vertices")
        ->group("Output");
    CLI::App* deform =
        add_verb(&app_, "deform", "Write the shapes of a clip by a skinning method", Verb::Deform);
    add_rig_options(deform);
    add_frame_options(deform);
    deform
        ->add_option("--deform", line_.skinning.deform_method,
                     "lbs, dqs, poisson, context, context-face or context-polar")
        ->check(CLI::IsMember({"lbs", "dqs", "poisson", "context", "context-face", "context-polar"})
                    .description(""))
        ->type_name("METHOD")
        ->default_str("lbs")
        ->group("Frames");
    deform->add_option("--format", line_.skinning.format, "obj or ply")
        ->check(CLI::IsMember({"obj", "ply"}).description(""))
        ->type_name("FORMAT")
        ->default_str("obj")
        ->group("Output");
    CLI::App* compare = add_verb(&app_, "compare-skinning",
                                 "Measure and draw a clip by every skinning method", Verb::CompareSkinning);
    add_rig_options(compare);
    add_frame_options(compare);
  }

  void add_stage_verbs() {
    CLI::App* stage = add_group("stage", "List the stages of a recipe, or run one of them");
    CLI::App* run = add_verb(stage, "run", "Run one stage and what it needs, into the cache", Verb::StageRun);
    add_recipe(run);
    run->add_option("STAGE", line_.stage, "Name as `stage list` prints it, e.g. \"import horse\"")
        ->required()
        ->type_name("");
    add_report_option(run);
    add_work_options(run);
    CLI::App* list = add_verb(stage, "list", "Print the names of all stages", Verb::StageList);
    add_recipe(list);
    add_report_option(list);
    add_work_options(list);
  }

  void add_cache_verbs() {
    CLI::App* cache = add_group("cache", "Look after the cache");
    add_cache_option(add_verb(cache, "stats", "Count entries, bytes and saved seconds", Verb::CacheStats));
    CLI::App* gc = add_verb(cache, "gc", "Remove what was not asked for longest", Verb::CacheGc);
    add_cache_option(gc);
    gc->add_option("--max-size", line_.max_size_gb, "Keep at most so much")
        ->check(CLI::Range(0.0, 1e6).description(""))
        ->type_name("GB")
        ->default_str("any");
    gc->add_option("--max-age", line_.max_age_days, "Remove what was not asked for since")
        ->check(CLI::Range(0.0, 1e5).description(""))
        ->type_name("DAYS")
        ->default_str("any");
    CLI::App* pin =
        add_verb(cache, "pin", "Keep what the last build of recipes made from gc", Verb::CachePin);
    add_recipes(pin);
    add_cache_option(pin);
    CLI::App* unpin = add_verb(cache, "unpin", "Take that back", Verb::CacheUnpin);
    add_recipes(unpin);
    add_cache_option(unpin);
    add_cache_option(
        add_verb(cache, "verify", "Read everything, remove what is damaged (status 4)", Verb::CacheVerify));
    add_cache_option(add_verb(cache, "clear", "Remove every entry", Verb::CacheClear));
    add_cache_option(add_verb(cache, "path", "Print its folder", Verb::CachePath));
  }

  void add_diff_verb() {
    DiffRequest& request = line_.diff;
    CLI::App* diff = add_verb(
        &app_, "diff", "Compare two models: structure, surface, weights, every clip (status 5)", Verb::Diff);
    diff->add_option("A", request.a, "Model to compare with")->required()->type_name("");
    diff->add_option("B", request.b, "Model to compare")->required()->type_name("");
    diff->add_option("--threshold", request.thresholds,
                     "What is still the same: geometry and animation in % of A's diagonal (0.001%, 0.05%), "
                     "weights (0.01 of 2), duration (0.001 s), structure (none, or any edits)")
        ->type_name("NAME=LIMIT")
        ->group("Verdict");
    diff->add_flag("--accept", request.accept,
                   "Put B in the place of A, with a note beside it of what changed")
        ->group("Verdict");
    diff->add_option("--html", request.html,
                     "Write a page with both side by side, one camera and one clock, and where they differ")
        ->type_name("FILE")
        ->group("Output");
    diff->add_option("--junit", request.junit, "Write the verdicts as JUnit XML, too")
        ->type_name("FILE")
        ->group("Output");
    add_jobs_option(diff);
  }

  void add_other_verbs() {
    CLI::App* inspect = add_verb(&app_, "inspect",
                                 "Show what a model holds: joints, clips, weights, topology", Verb::Inspect);
    inspect->add_option("FILE", line_.file, "Model: .glb, .gltf, .fbx, .dae, .obj, ...")
        ->required()
        ->type_name("");
    add_diff_verb();
    CLI::App* verify =
        add_verb(&app_, "verify", "Check that a GLB is as it was written, and what it was made of (status 4)",
                 Verb::Verify);
    verify->add_option("FILE", line_.file, "A GLB that this tool made")->required()->type_name("");
    verify->add_option("--recipe", recipe_, "Recipe to compare with: what it asks for, and its files")
        ->type_name("RECIPE");
    add_choice_options(verify);
    add_file_verbs();
    add_cache_option(add_verb(&app_, "doctor", "Say whether all that builds need is there", Verb::Doctor));
    add_verb(&app_, "completion", "Print a script by which a shell completes commands", Verb::Completion)
        ->add_option("SHELL", shell_, "bash, zsh or fish")
        ->required()
        ->type_name("");
    add_verb(&app_, "schema", "Print the JSON Schema of recipes, reports or events", Verb::Schema)
        ->add_option("OF", line_.schema, "recipe, report or event")
        ->check(CLI::IsMember({"recipe", "report", "event"}).description(""))
        ->default_str("recipe")
        ->type_name("");
    add_verb(&app_, "version", "Print the version", Verb::Version);
    add_verb(&app_, "help", "Print this, or the help of a command or topic", Verb::Help)
        ->add_option("TOPIC", topic_, "A command, or one of: status, environment, recipe, caching, ci")
        ->type_name("");
  }

  void add_file_verbs() {
    CLI::App* validate =
        add_verb(&app_, "validate", "Check a glTF or GLB file against the rules of the format (status 4)",
                 Verb::Validate);
    validate->add_option("FILE", line_.file, "A .glb or .gltf")->required()->type_name("");
    validate->add_flag("--strict", line_.strict, "Warnings count, too")->group("Verdict");
    validate
        ->add_flag("--own-rules", line_.without_khronos,
                   "Do not ask the Khronos validator, even if it is there")
        ->group("Verdict");
    CLI::App* repair =
        add_verb(&app_, "repair", "Write a model anew as a valid GLB, and say each thing that was repaired",
                 Verb::Repair);
    repair->add_option("FILE", line_.file, "Model: .glb, .gltf, .fbx, .dae, .obj, ...")
        ->required()
        ->type_name("");
    repair->add_option("-o,--out", line_.out, "File to write")
        ->type_name("FILE.glb")
        ->default_str("FILE with the ending .repaired.glb")
        ->group("Output");
    repair->add_option("--influences", line_.influences, "Joints a vertex follows at most: 4 or 8")
        ->check(CLI::IsMember(std::vector<std::size_t>{4, 8}).description(""))
        ->type_name("N")
        ->default_str("8 where the model has more than 4")
        ->group("Output");
  }

  CLI::App app_{"Grafts parts of rigged, animated characters into one.", "skinforge"};
  CommandLine line_;
  std::map<const CLI::App*, Verb> verbs_;
  /// Values that options take, for shells.
  static inline const std::map<std::string, std::vector<std::string>> choices_ = {
      {"--report", {"none", "json", "full"}},
      {"--format", {"dot", "json"}},
      {"--influences", {"4", "8"}},
      {"--method", {"harmonic", "heat"}},
      {"--kernel", {"linear", "gaussian"}}};
  std::string topic_;
  std::string shell_;
  std::string recipe_;
  std::string report_ = "full";
  bool quiet_ = false;
  std::vector<std::string> raised_;
  bool verbose_ = false;
};
}  // namespace

CommandLine parse_command_line(const std::vector<std::string>& arguments) {
  return Parser().parse(arguments);
}

}  // namespace skinforge
