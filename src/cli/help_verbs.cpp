#include "cli/verb_tree.h"

namespace skinforge {

void VerbTree::add_help_verbs() {
  add_cache_option(add_verb(&app, "doctor", "Say whether all that builds need is there", Verb::Doctor));
  add_verb(&app, "completion", "Print a script by which a shell completes commands", Verb::Completion)
      ->add_option("SHELL", shell, "bash, zsh or fish")
      ->required()
      ->type_name("");
  add_verb(&app, "schema", "Print the JSON Schema of recipes, reports or events", Verb::Schema)
      ->add_option("OF", line.schema, "recipe, report or event")
      ->check(CLI::IsMember({"recipe", "report", "event"}).description(""))
      ->default_str("recipe")
      ->type_name("");
  add_verb(&app, "version", "Print the version", Verb::Version);
  add_verb(&app, "help", "Print this, or the help of a command or topic", Verb::Help)
      ->add_option("TOPIC", topic, "A command, or one of: status, environment, recipe, caching, ci")
      ->type_name("");
}

}  // namespace skinforge
