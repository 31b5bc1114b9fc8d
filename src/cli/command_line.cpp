#include "cli/command_line.h"

#include <fmt/core.h>

#include <map>

#include "base/error.h"
#include "base/text.h"
#include "cli/completion_text.h"
#include "cli/help_topics.h"
#include "cli/verb_tree.h"
#include "stages/build.h"

namespace skinforge {

namespace {
constexpr const char* kHint = "; skinforge help shows what there is";

ReportLevel report_level(const std::string& word) {
  if (word == "none") return ReportLevel::None;
  return word == "json" ? ReportLevel::Json : ReportLevel::Full;
}

// Values that options take, for shells.
const std::map<std::string, std::vector<std::string>> kChoices = {{"--report", {"none", "json", "full"}},
                                                                  {"--format", {"dot", "json"}},
                                                                  {"--influences", {"4", "8"}},
                                                                  {"--method", {"harmonic", "heat"}},
                                                                  {"--kernel", {"linear", "gaussian"}}};

// App::help would go on to the verb that was given.
std::string help_of(const CLI::App* app) {
  std::string name = app->get_name();
  for (const CLI::App* parent = app->get_parent(); parent; parent = parent->get_parent())
    name = parent->get_name() + " " + name;
  return app->get_formatter()->make_help(app, name, CLI::AppFormatMode::Normal);
}

std::vector<std::string> verb_names(const CLI::App* app) {
  std::vector<std::string> names;
  for (const CLI::App* verb : app->get_subcommands(nullptr)) names.push_back(verb->get_name());
  return names;
}

VerbWords::Option option_words(const CLI::Option* option) {
  VerbWords::Option words;
  for (const std::string& name : option->get_lnames()) words.names.push_back("--" + name);
  for (const std::string& name : option->get_snames()) words.names.push_back("-" + name);
  words.what = option->get_description();
  words.takes_value = option->get_items_expected_max() > 0;
  if (const auto choices = kChoices.find(words.names.front()); choices != kChoices.end())
    words.choices = choices->second;
  return words;
}

// What shells need to know, of all verbs below `app`.
std::vector<VerbWords> verb_words(const CLI::App* app, const std::string& prefix) {
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

std::string names_below(const CLI::App* app) {
  std::string names;
  for (const std::string& name : verb_names(app)) names += (names.empty() ? "" : ", ") + name;
  return names;
}

std::vector<std::string> option_names(const CLI::App* app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app->get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

// The innermost verb that was given; the app itself when there is none.
const CLI::App* chosen(const CLI::App* app) {
  const auto given = app->get_subcommands();
  return given.empty() ? app : chosen(given.front());
}

// Words that no verb took: mistyped verbs and options, with the nearest right ones.
void expect_nothing_left(const CLI::App* app) {
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

std::string help_about(const std::string& topic, const CLI::App& app) {
  if (topic.empty()) return help_of(&app);
  if (topic == "limits")
    return "What inputs may ask for, as --limit NAME=VALUE changes it:\n" + limit_table();
  for (const CLI::App* verb : app.get_subcommands(nullptr))
    if (verb->get_name() == topic) return help_of(verb);
  if (const auto text = help_topic(topic)) return *text;
  std::vector<std::string> known = verb_names(&app), topics = help_topic_names();
  known.insert(known.end(), topics.begin(), topics.end());
  throw Error(ExitCode::Usage,
              fmt::format("unknown command \"{}\"{}", printable(topic), nearest_hint(topic, known)));
}

// What the words say, once they all are read.
CommandLine read(VerbTree& tree) {
  expect_nothing_left(&tree.app);
  const CLI::App* verb = chosen(&tree.app);
  if (verb == &tree.app) throw Error(ExitCode::Usage, std::string("a command is missing") + kHint);
  if (verb->get_parent() == &tree.app && !tree.verbs.contains(verb))
    throw Error(ExitCode::Usage, "\"" + verb->get_name() + "\" needs one of: " + names_below(verb));
  CommandLine& line = tree.line;
  line.verb = tree.verbs.at(verb);
  line.report = report_level(tree.report);
  if (!tree.recipe.empty()) line.recipes = {tree.recipe};
  if (line.verb == Verb::Help) line.help = help_about(tree.topic, tree.app);
  for (const std::string& text : tree.raised) set_limit(line.limits, text);
  if (line.verb == Verb::Completion) line.help = completion_script(tree.shell, verb_words(&tree.app, ""));
  line.verbosity = tree.quiet ? Verbosity::Quiet : tree.verbose ? Verbosity::Verbose : Verbosity::Normal;
  return line;
}

CommandLine help(CommandLine line, const std::string& text) {
  line.verb = Verb::Help;
  line.help = text;
  return line;
}
}  // namespace

CommandLine parse_command_line(const std::vector<std::string>& arguments) {
  VerbTree tree;
  try {
    tree.app.parse(
        std::vector<std::string>(arguments.rbegin(), arguments.rend()));  // CLI11 takes them from the back
  } catch (const CLI::CallForHelp&) {
    return help(tree.line, help_of(chosen(&tree.app)));
  } catch (const CLI::CallForAllHelp&) {
    return help(tree.line, tree.app.help("", CLI::AppFormatMode::All));
  } catch (const CLI::CallForVersion& version) {
    return help(tree.line, version.what());
  } catch (const CLI::ParseError& error) {
    expect_nothing_left(&tree.app);
    throw Error(ExitCode::Usage, printable(error.what()) + kHint);
  }
  return read(tree);
}

}  // namespace skinforge
