#pragma once

#include <chrono>
#include <map>
#include <optional>
#include <set>

#include "cli/console.h"
#include "pipeline/engine.h"

namespace skinforge {

class RecipeEvents;

/// Tells how a build goes: a bar on terminals, one line for each stage that ran elsewhere. Warnings of stages
/// come as they end.
class Progress final : public EngineObserver {
 public:
  /// `events` may be null.
  Progress(Console& console, RecipeEvents* events) : console_(console), events_(events) {}

  /// Stages known so far; the bar is drawn against it.
  void set_total(std::size_t stages) { total_ = stages; }
  /// Seconds that stages took when they last ran, by label: what is left is estimated from them.
  void expect(std::map<std::string, double> seconds) { expected_ = std::move(seconds); }
  void on_start(const StageInfo& info) override;
  void on_finish(const StageResult& result) override;
  /// Takes the bar away.
  void end() { console_.status(""); }
  /// Seconds from the beginning of the build to that of a stage; none when it did not run.
  std::optional<double> begin_of(const std::string& label) const;

 private:
  void draw();
  std::string time_left() const;

  Console& console_;
  RecipeEvents* events_;
  std::size_t total_ = 0;
  std::size_t done_ = 0;
  std::set<std::string> running_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::map<std::string, double> begins_;    // by label, seconds
  std::map<std::string, double> expected_;  // of stages that are not done
};

}  // namespace skinforge
