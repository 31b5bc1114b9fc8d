#pragma once

#include <optional>
#include <string>
#include <vector>

namespace skinforge {

/// How another program ended.
struct ChildResult {
  int status = 0;  ///< exit status; 128 + signal
  std::string out;
};

/// Runs a program by name ($PATH) and waits for it; stdin is empty, stderr thrown away. None where it cannot
/// be started or takes longer than `seconds`.
std::optional<ChildResult> run_child(const std::vector<std::string>& words, int seconds);

}  // namespace skinforge
