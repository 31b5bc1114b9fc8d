#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace skinforge {

/// What one stage cost. Kept apart from the report, which must not differ from run to run.
struct StageTiming {
  std::string stage;
  std::string subject;
  std::string outcome;
  double wall = 0;
  double cpu = 0;
  std::int64_t peak_memory = 0;
  std::optional<double> begin = {};  ///< seconds after the build began; none where that is not known
};

struct Timings {
  double wall = 0;
  double cpu = 0;
  std::int64_t peak_memory = 0;
  std::vector<StageTiming> stages;
};

}  // namespace skinforge
