#include "cli/build_pool.h"

#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <map>
#include <mutex>
#include <optional>
#include <system_error>
#include <thread>

#include "pipeline/work_share.h"

namespace skinforge {

namespace {
// Recipes that wait, are built, or have been; each talks through a console that keeps it back until those
// before it have spoken.
class BuildPool {
 public:
  BuildPool(const CommandLine& line, const std::vector<RecipeTask>& tasks, WorkShare& share, Console& console,
            EventStream& events)
      : line_(line),
        tasks_(tasks),
        share_(share),
        console_(console),
        events_(events),
        results_(tasks.size()) {}

  std::vector<Outcome> run() {
    std::vector<std::thread> helpers;
    try {
      for (std::size_t i = 1; i < std::min(line_.jobs, tasks_.size()); ++i)
        helpers.emplace_back([this] { work(); });
    } catch (const std::system_error&) {  // no more threads to be had
    }
    work();
    for (std::thread& helper : helpers) helper.join();
    console_.status("");
    std::vector<Outcome> outcomes;
    for (auto& result : results_)
      if (result) outcomes.push_back(std::move(*result));
    return outcomes;
  }

 private:
  void work() {
    while (!is_stopped_) {
      const std::size_t task = next_++;
      if (task >= tasks_.size()) return;
      auto console = std::make_unique<Console>(line_.verbosity);
      console->hold();
      Outcome outcome = build_recipe(line_, tasks_[task], *console, events_, share_, false);
      finish(task, std::move(outcome), std::move(console));
    }
  }

  void finish(std::size_t task, Outcome outcome, std::unique_ptr<Console> console) {
    if (outcome.code != ExitCode::Ok && !line_.keep_going) is_stopped_ = true;
    const std::lock_guard lock(mutex_);
    results_[task] = std::move(outcome);
    waiting_[task] = std::move(console);
    console_.status("");
    for (; !waiting_.empty() && waiting_.begin()->first == told_; ++told_) {
      waiting_.begin()->second->release();
      waiting_.erase(waiting_.begin());
    }
    console_.status(fmt::format("{}/{} recipes", told_ + waiting_.size(), tasks_.size()));
  }

  const CommandLine& line_;
  const std::vector<RecipeTask>& tasks_;
  WorkShare& share_;
  Console& console_;
  EventStream& events_;
  std::atomic<std::size_t> next_ = 0;
  std::atomic<bool> is_stopped_ = false;
  std::mutex mutex_;
  std::vector<std::optional<Outcome>> results_;
  std::map<std::size_t, std::unique_ptr<Console>> waiting_;  // by task; those before have not spoken
  std::size_t told_ = 0;
};
}  // namespace

std::vector<Outcome> build_all(const CommandLine& line, const std::vector<RecipeTask>& tasks,
                               WorkShare& share, Console& console, EventStream& events) {
  return BuildPool(line, tasks, share, console, events).run();
}

}  // namespace skinforge
