#include "cli/console.h"

#include <fmt/core.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

#include "base/error.h"
#include "base/text.h"

namespace skinforge {

namespace {
bool is_set(const char* name) {
  const char* value = std::getenv(name);
  return value && *value;
}

bool is_capable_terminal() {
  const char* terminal = std::getenv("TERM");
  return ::isatty(STDERR_FILENO) && terminal && std::string_view(terminal) != "dumb";
}

spdlog::color_mode color_mode() {
  if (is_set("NO_COLOR")) return spdlog::color_mode::never;
  if (is_set("CLICOLOR_FORCE")) return spdlog::color_mode::always;
  return is_capable_terminal() ? spdlog::color_mode::always : spdlog::color_mode::never;
}

spdlog::level::level_enum level(Verbosity verbosity) {
  if (verbosity == Verbosity::Quiet) return spdlog::level::warn;
  return verbosity == Verbosity::Verbose ? spdlog::level::debug : spdlog::level::info;
}
}  // namespace

Console::Console(Verbosity verbosity) {
  auto sink = std::make_shared<spdlog::sinks::stderr_color_sink_mt>(color_mode());
  for (const auto plain : {spdlog::level::info, spdlog::level::debug})
    sink->set_color(plain, std::string_view());
  logger_ = std::make_shared<spdlog::logger>("skinforge", std::move(sink));
  logger_->set_pattern("%^%v%$");
  logger_->set_level(level(verbosity));
  logger_->flush_on(spdlog::level::debug);
  has_status_line_ =
      verbosity != Verbosity::Quiet && is_capable_terminal() && !is_set("NO_COLOR") && !is_set("CI");
}

Console::~Console() {
  clear_status();
}

void Console::detail(const std::string& text) {
  say(spdlog::level::debug, text);
}

void Console::info(const std::string& text) {
  say(spdlog::level::info, text);
}

void Console::warn(const std::string& text) {
  say(spdlog::level::warn, "warning: " + text);
}

void Console::error(const std::string& text) {
  say(spdlog::level::err, "error: " + text);
}

void Console::say(int level, const std::string& text) {
  if (is_holding_) {
    held_.push_back({level, text});
    return;
  }
  clear_status();
  logger_->log(static_cast<spdlog::level::level_enum>(level), text);
}

void Console::hold() {
  is_holding_ = true;
  has_status_line_ = false;
}

void Console::release() {
  is_holding_ = false;
  for (const Line& line : std::exchange(held_, {})) say(line.level, line.text);
}

void Console::issue(const Issue& issue) {
  const std::string line = printable(fmt::format("{}: {} [{}]", issue.place, issue.message, issue.code));
  if (issue.severity == Severity::Warning)
    warn(line);
  else
    detail("note: " + line);
}

void Console::status(const std::string& text) {
  if (!has_status_line_) return;
  clear_status();
  if (text.empty()) return;
  std::fputs(text.c_str(), stderr);
  std::fflush(stderr);
  is_status_shown_ = true;
}

void Console::clear_status() {
  if (!is_status_shown_) return;
  std::fputs("\r\x1b[K", stderr);
  std::fflush(stderr);
  is_status_shown_ = false;
}

void print_data(std::string_view text) {
  const bool is_ended = text.ends_with('\n');
  const bool is_written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size() &&
                          (is_ended || std::fputc('\n', stdout) != EOF) && std::fflush(stdout) == 0;
  if (!is_written) throw Error(ExitCode::StageFailed, "cannot write to the standard output");
}

}  // namespace skinforge
