#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "base/issue.h"

namespace spdlog {
class logger;
}

namespace skinforge {

enum class Verbosity { Quiet, Normal, Verbose };

/// Talk to the person, on stderr, one line each. Colour and the status line are for terminals only; NO_COLOR
/// turns both off, CLICOLOR_FORCE turns colour on, CI the status line off.
class Console {
 public:
  explicit Console(Verbosity verbosity);
  ~Console();

  void detail(const std::string& text);  ///< with -v
  void info(const std::string& text);    ///< without -q
  void warn(const std::string& text);
  void error(const std::string& text);
  /// "warning: man.fbx: 3 weights were not finite [weights-repaired]"; notes are details.
  void issue(const Issue& issue);

  bool has_status_line() const { return has_status_line_; }
  /// Shows a line that the next one replaces; nothing where there is no status line. Empty: takes it away.
  void status(const std::string& text);

 private:
  void clear_status();
  std::shared_ptr<spdlog::logger> logger_;
  bool has_status_line_ = false;
  bool is_status_shown_ = false;
};

/// Data to stdout, followed by a line break unless it ends in one. Throws Error (StageFailed) when stdout is
/// closed or full.
void print_data(std::string_view text);

}  // namespace skinforge
