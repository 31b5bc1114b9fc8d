#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/archive.h"

namespace skinforge {

/// How values spread, in the values' own unit.
struct Distribution {
  std::int64_t count = 0;
  double min = 0;
  double mean = 0;
  double p05 = 0;
  double p25 = 0;
  double p50 = 0;
  double p75 = 0;
  double p95 = 0;
  double max = 0;

  template <class Archive>
  friend void fields(Archive& a, Distribution& d) {
    a(d.count, d.min, d.mean, d.p05, d.p25, d.p50, d.p75, d.p95, d.max);
  }
};

/// The distribution of `values`, or none when there are none. Percentile p lies at rank p / 100 * (n - 1) of
/// the sorted values, linear between ranks. Sums in sorted order, so the order of `values` does not matter.
/// O(n log n).
std::optional<Distribution> distribution_of(std::vector<double> values);

}  // namespace skinforge
