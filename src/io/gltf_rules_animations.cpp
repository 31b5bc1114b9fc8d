#include <fmt/format.h>

#include <cmath>
#include <set>

#include "io/gltf_rule_context.h"

namespace skinforge {

namespace {
void check_times(const JsonPlace& input, GltfRules& rules) {
  const std::size_t accessor = input.index(rules.document.accessors.size(), "accessor");
  const GltfValues& times = rules.values(accessor);
  std::size_t falling = 0, negative = 0;
  for (std::size_t i = 0; i < times.count; ++i) {
    falling += i > 0 && times.numbers[i] <= times.numbers[i - 1];
    negative += times.numbers[i] < 0;
  }
  const std::string pointer = rules.accessor_pointer(accessor);
  if (falling > 0)
    rules.error("ACCESSOR_ANIMATION_INPUT_NON_INCREASING", pointer,
                fmt::format("{} of {} key times are not above the one before", falling, times.count));
  if (negative > 0)
    rules.error("ACCESSOR_ANIMATION_INPUT_NEGATIVE", pointer,
                fmt::format("{} key times are negative", negative));
  const JsonPlace place = rules.document.root.get("accessors").at(accessor);
  if (!place.has("min") || !place.has("max"))
    rules.error("ANIMATION_SAMPLER_INPUT_ACCESSOR_WITHOUT_BOUNDS", input.place(),
                "key times need their first and last value (min, max)");
}

// Keys of a rotation are quaternions of unit length; of a cubic spline every second of three values is a key.
void check_rotations(const JsonPlace& sampler, GltfRules& rules) {
  const bool is_cubic = sampler.text_or("interpolation", "LINEAR") == "CUBICSPLINE";
  const std::size_t accessor = sampler.get("output").index(rules.document.accessors.size(), "accessor");
  const GltfValues& values = rules.values(accessor);
  if (values.components != 4) return;
  std::size_t bad = 0;
  for (std::size_t i = is_cubic ? 1 : 0; i < values.count; i += is_cubic ? 3 : 1) {
    const double* q = values[i];
    const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    bad += std::isfinite(length) && std::abs(length - 1) > kUnitQuaternion;
  }
  if (bad > 0)
    rules.error("ACCESSOR_ANIMATION_SAMPLER_OUTPUT_NON_NORMALIZED_QUATERNION",
                rules.accessor_pointer(accessor), fmt::format("{} rotations are not of unit length", bad));
}

void check_count(const JsonPlace& sampler, const std::string& path, GltfRules& rules) {
  if (path == "weights") return;  // as many as the mesh has morph targets
  const auto count = [&](const char* key) {
    return rules.document.accessors[sampler.get(key).index(rules.document.accessors.size(), "accessor")]
        .count;
  };
  const bool is_cubic = sampler.text_or("interpolation", "LINEAR") == "CUBICSPLINE";
  const std::size_t wanted = count("input") * (is_cubic ? 3 : 1);
  if (count("output") != wanted)
    rules.error("ANIMATION_SAMPLER_OUTPUT_ACCESSOR_INVALID_COUNT", sampler.get("output").place(),
                fmt::format("{} values for {} keys", count("output"), count("input")));
}
}  // namespace

void check_animations(GltfRules& rules) {
  for (const JsonPlace& animation : rules.document.root.objects("animations")) {
    const auto samplers = animation.required_objects("samplers");
    std::set<std::size_t> checked;  // inputs
    for (const JsonPlace& sampler : samplers)
      if (checked.insert(sampler.get("input").index(rules.document.accessors.size(), "accessor")).second)
        check_times(sampler.get("input"), rules);
    std::set<std::pair<std::size_t, std::string>> targets;
    for (const JsonPlace& channel : animation.required_objects("channels")) {
      const JsonPlace& sampler = samplers[channel.get("sampler").index(samplers.size(), "sampler")];
      const JsonPlace target = channel.get("target");
      const std::string path = target.text_or("path", "");
      if (const auto node = target.find("node"); node && !targets.insert({node->count(), path}).second)
        rules.error("ANIMATION_DUPLICATE_TARGETS", channel.place() + "/target",
                    "another channel of this animation drives the same property");
      if (path == "rotation") check_rotations(sampler, rules);
      check_count(sampler, path, rules);
    }
  }
}

}  // namespace skinforge
