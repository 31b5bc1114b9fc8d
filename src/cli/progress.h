#pragma once

#include <chrono>
#include <map>
#include <optional>
#include <set>

#include "cli/console.h"
#include "pipeline/engine.h"

namespace skinforge {

/// Tells how a build goes: a bar on terminals, one line for each stage that ran elsewhere. Warnings of stages
/// come as they end.
class Progress final : public EngineObserver {
 public:
  explicit Progress(Console& console) : console_(console) {}

  /// Stages known so far; the bar is drawn against it.
  void set_total(std::size_t stages) { total_ = stages; }
  void on_start(const StageInfo& info) override;
  void on_finish(const StageResult& result) override;
  /// Takes the bar away.
  void end() { console_.status(""); }
  /// Seconds from the beginning of the build to that of a stage; none when it did not run.
  std::optional<double> begin_of(const std::string& label) const;

 private:
  void draw();

  Console& console_;
  std::size_t total_ = 0;
  std::size_t done_ = 0;
  std::set<std::string> running_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::map<std::string, double> begins_;  // by label, seconds
};

}  // namespace skinforge
