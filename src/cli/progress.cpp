#include "cli/progress.h"

#include <fmt/core.h>

#include <algorithm>

#include "base/text.h"
#include "cli/event_stream.h"

namespace skinforge {

namespace {
constexpr std::size_t kBarWidth = 24;  // ours: leaves room for a stage's name in 80 columns
constexpr std::size_t kNameWidth = 40;
}  // namespace

void Progress::on_start(const StageInfo& info) {
  running_.insert(info.label());
  const std::chrono::duration<double> begin = std::chrono::steady_clock::now() - start_;
  begins_[info.label()] = begin.count();
  if (events_) events_->stage_started(info);
  draw();
}

std::optional<double> Progress::begin_of(const std::string& label) const {
  const auto found = begins_.find(label);
  return found == begins_.end() ? std::nullopt : std::optional(found->second);
}

void Progress::on_finish(const StageResult& result) {
  ++done_;
  running_.erase(result.info.label());
  expected_.erase(result.info.label());
  if (events_) events_->stage_finished(result);
  const std::string label = printable(result.info.label());
  for (const Issue& issue : result.issues) console_.issue(issue);
  const std::string line = fmt::format("{} ({:.2f} s, {})", label, result.cost.wall_seconds, result.reason);
  if (result.status == StageStatus::Ran && console_.has_status_line())
    console_.detail(line);
  else if (result.status == StageStatus::Ran)
    console_.info(line);
  else if (result.status == StageStatus::Hit)
    console_.detail(label + " (from the cache)");
  draw();
}

void Progress::draw() {
  if (running_.empty()) return;  // hits are too quick to show
  const std::size_t total = std::max({total_, done_, std::size_t{1}});
  const std::size_t filled = kBarWidth * done_ / total;
  console_.status(fmt::format("[{}{}] {}/{}{} {}", std::string(filled, '#'),
                              std::string(kBarWidth - filled, '.'), done_, total, time_left(),
                              printable(*running_.begin()).substr(0, kNameWidth)));
}

// Of stages that took long enough to be counted when they last ran; nothing where that is unknown.
std::string Progress::time_left() const {
  double left = 0;
  for (const auto& [label, seconds] : expected_) left += seconds;
  return left < 1 ? "" : fmt::format(", about {:.0f} s", left);
}

}  // namespace skinforge
