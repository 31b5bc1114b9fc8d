#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

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

  /// Keeps back what is said from now on, for one of several that talk at a time; there is no status line
  /// then. `release` says it.
  void hold();
  void release();

  bool has_status_line() const { return has_status_line_; }
  /// Shows a line that the next one replaces; nothing where there is no status line. Empty: takes it away.
  void status(const std::string& text);

 private:
  void say(int level, const std::string& text);
  void clear_status();

  struct Line {
    int level;  // of spdlog
    std::string text;
  };
  std::shared_ptr<spdlog::logger> logger_;
  std::vector<Line> held_;
  bool is_holding_ = false;
  bool has_status_line_ = false;
  bool is_status_shown_ = false;
};

/// Data to stdout, followed by a line break unless it ends in one. Throws Error (StageFailed) when stdout is
/// closed or full.
void print_data(std::string_view text);

}  // namespace skinforge
