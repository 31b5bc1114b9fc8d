#include "pipeline/schedule.h"

#include "base/error.h"

namespace skinforge {

Schedule::Schedule(const std::vector<std::set<std::size_t>>& waits_for)
    : open_waits_(waits_for.size()), followers_(waits_for.size()) {
  for (std::size_t task = 0; task < waits_for.size(); ++task) {
    open_waits_[task] = waits_for[task].size();
    for (const std::size_t maker : waits_for[task]) followers_[maker].push_back(task);
    if (waits_for[task].empty()) ready_.insert(task);
  }
  expect_no_circle();
}

void Schedule::expect_no_circle() const {
  std::vector<std::size_t> waits = open_waits_;
  std::vector<std::size_t> order(ready_.begin(), ready_.end());
  for (std::size_t k = 0; k < order.size(); ++k)
    for (const std::size_t next : followers_[order[k]])
      if (--waits[next] == 0) order.push_back(next);
  if (order.size() != open_waits_.size())
    throw Error(ExitCode::Internal, "the stages read from each other in a circle");
}

std::optional<std::size_t> Schedule::take() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return !ready_.empty() || done_ == open_waits_.size(); });
  if (ready_.empty()) return std::nullopt;
  const std::size_t task = *ready_.begin();
  ready_.erase(ready_.begin());
  return task;
}

void Schedule::done(std::size_t task) {
  const std::lock_guard lock(mutex_);
  for (const std::size_t next : followers_[task])
    if (--open_waits_[next] == 0) ready_.insert(next);
  ++done_;
  changed_.notify_all();
}

}  // namespace skinforge
