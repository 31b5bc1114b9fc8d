#include "report/frame_runs.h"

#include <algorithm>
#include <cmath>

namespace skinforge {
namespace {

// The step a run keeps, known from its second frame on.
class Run {
 public:
  explicit Run(const ChosenFrame& first)
      : run_{first.source, first.clip, first.time, first.clip_time, first.clip_time, 1}, time_(first.time) {}

  bool takes(const ChosenFrame& next) const {
    if (next.source != run_.source || next.clip != run_.clip) return false;
    const double passed = next.time - time_, step = next.clip_time - run_.clip_end;
    if (run_.frames == 1) return std::abs(step) <= 1.5 * passed;  // at most normal speed, either way
    return std::abs(step - step_) <= 0.5 * passed;
  }
  void add(const ChosenFrame& next) {
    step_ = next.clip_time - run_.clip_end;
    run_.clip_end = next.clip_time;
    time_ = next.time;
    ++run_.frames;
  }
  const FrameRun& run() const { return run_; }

 private:
  FrameRun run_;
  double time_;      ///< of the last frame, in the result
  double step_ = 0;  ///< of the source's clip, seconds
};

}  // namespace

std::vector<FrameRun> frame_runs(std::span<const ChosenFrame> frames) {
  std::vector<ChosenFrame> sorted(frames.begin(), frames.end());
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const ChosenFrame& a, const ChosenFrame& b) { return a.source < b.source; });
  std::vector<Run> runs;
  for (const ChosenFrame& frame : sorted) {
    if (!runs.empty() && runs.back().takes(frame))
      runs.back().add(frame);
    else
      runs.emplace_back(frame);
  }
  std::vector<FrameRun> result;
  for (const Run& run : runs) result.push_back(run.run());
  return result;
}

}  // namespace skinforge
