#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/gltf_rule_context.h"

namespace skinforge {

namespace {
// Declared minima or maxima against those that are there, both as 32-bit floats.
void check_bound(const JsonPlace& place, const char* key, const GltfAccessor& accessor,
                 const GltfValues& values, GltfRules& rules) {
  const auto declared = place.find(key);
  if (!declared || values.count == 0 || accessor.normalized) return;
  const bool is_min = std::string_view(key) == "min";
  const std::vector<double> bounds = declared->numbers(values.components);
  for (std::size_t c = 0; c < values.components; ++c) {
    double found = values[0][c];
    for (std::size_t i = 1; i < values.count; ++i)
      found = is_min ? std::min(found, values[i][c]) : std::max(found, values[i][c]);
    if (std::isfinite(found) && static_cast<float>(bounds[c]) != static_cast<float>(found))
      rules.error(is_min ? "ACCESSOR_MIN_MISMATCH" : "ACCESSOR_MAX_MISMATCH",
                  fmt::format("{}/{}/{}", place.place(), key, c),
                  fmt::format("declared as {:.9g}, found {:.9g}", bounds[c], found));
  }
}
}  // namespace

void check_accessors(GltfRules& rules) {
  const auto places = rules.document.root.objects("accessors");
  for (std::size_t i = 0; i < places.size(); ++i) {
    const GltfAccessor& accessor = rules.document.accessors[i];
    const GltfValues& values = rules.values(i);
    if (accessor.is_float()) {
      const auto bad = std::count_if(values.numbers.begin(), values.numbers.end(),
                                     [](double x) { return !std::isfinite(x); });
      if (bad > 0)
        rules.error("ACCESSOR_INVALID_FLOAT", places[i].place(),
                    fmt::format("{} of {} values are no finite numbers", bad, values.numbers.size()));
    }
    check_bound(places[i], "min", accessor, values, rules);
    check_bound(places[i], "max", accessor, values, rules);
  }
}

}  // namespace skinforge
