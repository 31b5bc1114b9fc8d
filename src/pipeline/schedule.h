#pragma once

#include <condition_variable>
#include <mutex>
#include <optional>
#include <set>
#include <vector>

namespace skinforge {

/// Hands out the tasks of a graph as soon as those they wait for are done, the lowest ready index first.
/// Thread-safe.
class Schedule {
 public:
  /// `waits_for`: per task, the tasks that must be done before. Throws Error (Internal) for a circle.
  explicit Schedule(const std::vector<std::set<std::size_t>>& waits_for);

  /// The next task; blocks while none is ready but some are running. None when all are done.
  std::optional<std::size_t> take();
  void done(std::size_t task);

 private:
  void expect_no_circle() const;

  std::vector<std::size_t> open_waits_;              ///< per task
  std::vector<std::vector<std::size_t>> followers_;  ///< per task, rising
  std::set<std::size_t> ready_;
  std::size_t done_ = 0;
  std::mutex mutex_;
  std::condition_variable changed_;
};

}  // namespace skinforge
