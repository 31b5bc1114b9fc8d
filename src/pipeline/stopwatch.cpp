#include "pipeline/stopwatch.h"

#include <sys/resource.h>

namespace skinforge {

namespace {
double seconds_of(clockid_t clock) {
  timespec now{};
  ::clock_gettime(clock, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

std::uint64_t peak_bytes() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}
}  // namespace

Stopwatch::Stopwatch(bool alone)
    : clock_(alone ? CLOCK_PROCESS_CPUTIME_ID : CLOCK_THREAD_CPUTIME_ID),
      wall_(seconds_of(CLOCK_MONOTONIC)),
      cpu_(seconds_of(clock_)) {}

StageCost Stopwatch::cost() const {
  return {seconds_of(CLOCK_MONOTONIC) - wall_, seconds_of(clock_) - cpu_, peak_bytes()};
}

}  // namespace skinforge
