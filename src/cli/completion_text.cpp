#include "cli/completion_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "base/error.h"
#include "base/text.h"

namespace skinforge {

namespace {
std::string joined(const std::vector<std::string>& words, const char* between = " ") {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

// In single quotes, as all three shells read them.
std::string quoted(const std::string& text) {
  std::string safe;
  for (const char c : text) safe += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return fmt::format("'{}'", safe);
}

std::vector<std::string> option_names(const VerbWords& verb) {
  std::vector<std::string> names;
  for (const VerbWords::Option& option : verb.options)
    names.insert(names.end(), option.names.begin(), option.names.end());
  return names;
}

// Words that can stand first, and behind a first word that is a group ("cache").
std::map<std::string, std::vector<std::string>> words_behind(const std::vector<VerbWords>& verbs) {
  std::map<std::string, std::vector<std::string>> words;
  for (const VerbWords& verb : verbs) {
    const auto space = verb.name.find(' ');
    const std::string first = verb.name.substr(0, space);
    auto& top = words[""];
    if (std::find(top.begin(), top.end(), first) == top.end()) top.push_back(first);
    if (space != std::string::npos) words[first].push_back(verb.name.substr(space + 1));
  }
  return words;
}

std::string bash_script(const std::vector<VerbWords>& verbs) {
  std::string text = R"(# skinforge completion for bash: source <(skinforge completion bash)
_skinforge() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} verb=${COMP_WORDS[1]}
  case "$verb" in
)";
  const auto groups = words_behind(verbs);
  for (const auto& [group, words] : groups)
    if (!group.empty())
      text += fmt::format(
          "    {0})\n      if [ \"$COMP_CWORD\" -eq 2 ]; then COMPREPLY=($(compgen -W {1} -- \"$word\")); "
          "return; fi\n"
          "      verb=\"{0} ${{COMP_WORDS[2]}}\" ;;\n",
          group, quoted(joined(words)));
  text += "  esac\n  if [ \"$COMP_CWORD\" -eq 1 ]; then COMPREPLY=($(compgen -W " +
          quoted(joined(groups.at(""))) + " -- \"$word\")); return; fi\n  case \"$verb $before\" in\n";
  for (const VerbWords& verb : verbs)
    for (const VerbWords::Option& option : verb.options)
      if (!option.choices.empty())
        for (const std::string& name : option.names)
          text += fmt::format("    \"{} {}\") COMPREPLY=($(compgen -W {} -- \"$word\")); return ;;\n",
                              verb.name, name, quoted(joined(option.choices)));
  text += "  esac\n  case \"$verb\" in\n";
  for (const VerbWords& verb : verbs)
    text += fmt::format("    \"{}\") [[ $word == -* ]] && COMPREPLY=($(compgen -W {} -- \"$word\")) ;;\n",
                        verb.name, quoted(joined(option_names(verb))));
  return text + "  esac\n}\ncomplete -o default -F _skinforge skinforge\n";
}

std::string zsh_option(const VerbWords::Option& option) {
  std::string what = option.what;
  std::replace(what.begin(), what.end(), '[', '(');
  std::replace(what.begin(), what.end(), ']', ')');
  std::replace(what.begin(), what.end(), ':', ';');
  const std::string value = !option.takes_value      ? ""
                            : option.choices.empty() ? ":value:_files"
                                                     : ":value:(" + joined(option.choices) + ")";
  std::string text;
  for (const std::string& name : option.names)
    text += fmt::format(" {}", quoted(fmt::format("{}[{}]{}", name, what, value)));
  return text;
}

std::string zsh_script(const std::vector<VerbWords>& verbs) {
  std::string text =
      "#compdef skinforge\n# skinforge completion for zsh: skinforge completion zsh > ~/.zfunc/_skinforge\n"
      "_skinforge() {\n  local verb=$words[2]\n  case \"$verb\" in\n";
  const auto groups = words_behind(verbs);
  for (const auto& [group, words] : groups)
    if (!group.empty())
      text += fmt::format(
          "    {0}) if (( CURRENT == 3 )); then compadd {1}; return; fi; verb=\"{0} $words[3]\" ;;\n", group,
          joined(words));
  text += "  esac\n  if (( CURRENT == 2 )); then compadd " + joined(groups.at("")) +
          "; return; fi\n  case \"$verb\" in\n";
  for (const VerbWords& verb : verbs) {
    text += fmt::format("    \"{}\") _arguments", verb.name);
    for (const VerbWords::Option& option : verb.options) text += zsh_option(option);
    text += " '*:file:_files' ;;\n";
  }
  return text + "  esac\n}\ncompdef _skinforge skinforge\n";
}

std::string fish_script(const std::vector<VerbWords>& verbs) {
  std::string text =
      "# skinforge completion for fish: skinforge completion fish > "
      "~/.config/fish/completions/skinforge.fish\n";
  std::set<std::string> groups;
  for (const VerbWords& verb : verbs) {
    const auto space = verb.name.find(' ');
    const std::string first = verb.name.substr(0, space),
                      rest = space == std::string::npos ? "" : verb.name.substr(space + 1);
    if (rest.empty() || groups.insert(first).second)
      text += fmt::format("complete -c skinforge -n __fish_use_subcommand -a {}{}\n", first,
                          rest.empty() ? " -d " + quoted(verb.what) : "");
    if (!rest.empty())
      text += fmt::format("complete -c skinforge -n '__fish_seen_subcommand_from {}' -f -a {} -d {}\n", first,
                          rest, quoted(verb.what));
    for (const VerbWords::Option& option : verb.options) {
      text += fmt::format("complete -c skinforge -n '__fish_seen_subcommand_from {}'",
                          rest.empty() ? first : rest);
      for (const std::string& name : option.names)
        text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
      if (option.takes_value) text += " -r";
      if (!option.choices.empty()) text += " -f -a " + quoted(joined(option.choices));
      text += " -d " + quoted(option.what) + "\n";
    }
  }
  return text;
}
}  // namespace

std::string completion_script(const std::string& shell, const std::vector<VerbWords>& verbs) {
  if (shell == "bash") return bash_script(verbs);
  if (shell == "zsh") return zsh_script(verbs);
  if (shell == "fish") return fish_script(verbs);
  const std::vector<std::string> shells = {"bash", "zsh", "fish"};
  throw Error(ExitCode::Usage,
              fmt::format("completion: no shell \"{}\"{}", printable(shell), nearest_hint(shell, shells)));
}

}  // namespace skinforge
