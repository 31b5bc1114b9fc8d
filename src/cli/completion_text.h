#pragma once

#include <string>
#include <vector>

namespace skinforge {

/// One verb as shells need to know it.
struct VerbWords {
  std::string name;  ///< "build", "cache gc"
  std::string what;  ///< one sentence
  struct Option {
    std::vector<std::string> names;  ///< "--out", "-o"
    std::string what;
    bool takes_value = false;
    std::vector<std::string> choices;  ///< of its value; empty: any, files are offered
  };
  std::vector<Option> options;
};

/// A script that a shell (bash, zsh or fish) reads to complete verbs, options, their choices, and files.
/// Throws Error (Usage) for another shell.
std::string completion_script(const std::string& shell, const std::vector<VerbWords>& verbs);

}  // namespace skinforge
