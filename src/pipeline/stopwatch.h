#pragma once

#include <ctime>

#include "pipeline/cache.h"

namespace skinforge {

/// Measures a stage from its making to `cost()`. `alone`: nothing else runs, so the CPU time of the whole
/// process, with all threads that help, is the stage's.
class Stopwatch {
 public:
  explicit Stopwatch(bool alone);
  StageCost cost() const;

 private:
  clockid_t clock_;
  double wall_, cpu_;
};

}  // namespace skinforge
