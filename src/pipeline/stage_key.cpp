#include "pipeline/stage_key.h"

#include <fmt/format.h>

#include <algorithm>

namespace skinforge {

namespace {
constexpr std::size_t kMaxReasons = 8;  // ours: an export reads every clip; a line should stay a line

// Value of the n-th field called `name` (a name may occur more than once); none when there are fewer.
std::optional<std::string> nth_value(const std::vector<HashedField>& items, const std::string& name,
                                     std::size_t n) {
  for (const HashedField& item : items)
    if (item.name == name && n-- == 0) return item.value;
  return std::nullopt;
}

std::size_t occurrences_before(const std::vector<HashedField>& items, std::size_t end) {
  return static_cast<std::size_t>(std::count_if(items.begin(), items.begin() + std::ptrdiff_t(end),
                                                [&](const auto& i) { return i.name == items[end].name; }));
}

void add_parameter_changes(const StageKey& now, const Manifest& last, std::vector<std::string>& changes) {
  for (std::size_t i = 0; i < now.parameters.size(); ++i) {
    const HashedField& item = now.parameters[i];
    const auto old = nth_value(last.parameters, item.name, occurrences_before(now.parameters, i));
    if (!old)
      changes.push_back(fmt::format("parameter {} is new: {}", item.name, item.value));
    else if (*old != item.value)
      changes.push_back(fmt::format("parameter {}: {} -> {}", item.name, *old, item.value));
  }
  for (std::size_t i = 0; i < last.parameters.size(); ++i) {
    const std::string& name = last.parameters[i].name;
    if (!nth_value(now.parameters, name, occurrences_before(last.parameters, i)))
      changes.push_back(fmt::format("parameter {} is gone", name));
  }
}

void add_input_changes(const StageKey& now, const Manifest& last, std::vector<std::string>& changes) {
  for (const HashedField& item : now.inputs) {
    const auto old = nth_value(last.inputs, item.name, 0);
    if (!old || *old != item.value)
      changes.push_back(fmt::format("input {} {}", item.name, old ? "changed" : "is new"));
  }
  for (const HashedField& item : last.inputs)
    if (!nth_value(now.inputs, item.name, 0)) changes.push_back(fmt::format("input {} is gone", item.name));
}
}  // namespace

StageKey stage_key(const Stage& stage, const StageInfo& info, const std::string& build,
                   const std::vector<Digest>& inputs) {
  StageKey key{.digest = {}, .build = build, .parameters = {}, .inputs = {}};
  Hasher parameters;
  parameters.log_to(key.parameters);
  stage.add_to_key(parameters);

  Hasher hasher;
  hasher.add("build", build);
  hasher.add("stage", info.name);
  hasher.add_value("version", info.version);
  hasher.add("parameters", parameters.finish());
  hasher.add_value("writes", std::uint64_t{info.writes.size()});
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    hasher.add("input", inputs[i]);
    key.inputs.push_back({info.reads[i], inputs[i].hex()});
  }
  key.digest = hasher.finish();
  return key;
}

std::string why_run(const StageInfo& info, const StageKey& now, const std::optional<Digest>& last_key,
                    const std::optional<Manifest>& last) {
  if (!last_key) return "never run";
  if (*last_key == now.digest) return "its cache entry is missing or damaged";
  if (!last) return "its last run is no longer in the cache";
  std::vector<std::string> changes;
  if (last->build != now.build) changes.push_back("the tool changed");
  if (last->version != info.version)
    changes.push_back(fmt::format("stage version {} -> {}", last->version, info.version));
  add_parameter_changes(now, *last, changes);
  add_input_changes(now, *last, changes);
  if (changes.empty()) return "the order of its inputs changed";
  const std::size_t left_out = changes.size() - std::min(changes.size(), kMaxReasons);
  changes.resize(changes.size() - left_out);
  return fmt::format("{}{}", fmt::join(changes, "; "), left_out ? fmt::format("; {} more", left_out) : "");
}

}  // namespace skinforge
