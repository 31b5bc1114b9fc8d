#include "pipeline/key_change.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace skinforge {
using Kind = KeyChange::Kind;

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

// Fields by name, the n-th of a name compared with the n-th.
std::vector<KeyChange> field_changes(Kind kind, const std::vector<HashedField>& before,
                                     const std::vector<HashedField>& after) {
  std::vector<KeyChange> changes;
  for (std::size_t i = 0; i < after.size(); ++i) {
    const auto old = nth_value(before, after[i].name, occurrences_before(after, i));
    if (old != after[i].value) changes.push_back({kind, after[i].name, old, after[i].value});
  }
  for (std::size_t i = 0; i < before.size(); ++i)
    if (!nth_value(after, before[i].name, occurrences_before(before, i)))
      changes.push_back({kind, before[i].name, before[i].value, std::nullopt});
  return changes;
}

std::vector<KeyChange> setting_changes(const StageInfo& stage, const Settings& before, const Settings& after,
                                       const ReadsSetting& reads) {
  std::vector<KeyChange> changes;
  const auto value = [](const Settings& settings, const std::string& name) {
    const auto found = settings.find(name);
    return found == settings.end() ? std::nullopt : std::optional<std::string>(found->second);
  };
  std::set<std::string> names;
  for (const Settings* settings : {&before, &after})
    for (const auto& [name, text] : *settings)
      if (reads && reads(stage, name)) names.insert(name);
  for (const std::string& name : names)
    if (value(before, name) != value(after, name))
      changes.push_back({Kind::Setting, name, value(before, name), value(after, name)});
  return changes;
}

bool is_digest(const std::optional<std::string>& value) {
  return !value || value->starts_with("sha256:") || digest_from_hex(*value);
}

// A parameter that a changed setting tells better: its values are digests, or those of the setting.
bool is_told(const KeyChange& parameter, const std::vector<KeyChange>& settings) {
  if (settings.empty()) return false;
  if (is_digest(parameter.before) && is_digest(parameter.after)) return true;
  return std::any_of(settings.begin(), settings.end(), [&](const KeyChange& setting) {
    return setting.before == parameter.before && setting.after == parameter.after;
  });
}

void append(std::vector<KeyChange>& changes, std::vector<KeyChange> more) {
  changes.insert(changes.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

std::vector<KeyChange> input_changes(const StageKey& now, const Manifest& last) {
  std::vector<KeyChange> changes = field_changes(Kind::Input, last.inputs, now.inputs);
  for (KeyChange& change : changes)
    if (change.after && change.after->empty()) change = {Kind::Pending, change.name, change.before, {}};
  return changes;
}

std::string value_text(const std::optional<std::string>& value) {
  return value ? *value : "(not set)";
}
}  // namespace

std::vector<KeyChange> key_changes(const StageInfo& info, const StageKey& now, const Settings& settings,
                                   const EarlierRun& earlier, const ReadsSetting& reads_setting) {
  if (!earlier.key) return {{Kind::NeverRun}};
  if (*earlier.key == now.digest) return {};
  if (!earlier.manifest) return {{Kind::Forgotten}};
  const Manifest& last = *earlier.manifest;
  std::vector<KeyChange> changes;
  if (last.build != now.build) changes.push_back({Kind::Tool, {}, last.build, now.build});
  if (last.version != info.version)
    changes.push_back({Kind::Version, {}, std::to_string(last.version), std::to_string(info.version)});
  std::vector<KeyChange> parameters = field_changes(Kind::Parameter, last.parameters, now.parameters);
  if (!parameters.empty()) {
    std::vector<KeyChange> told = setting_changes(info, earlier.settings, settings, reads_setting);
    const bool is_new_program = !changes.empty();  // whose options differ without anybody's doing
    std::erase_if(parameters, [&](const KeyChange& parameter) {
      return is_told(parameter, told) ||
             (is_new_program && is_digest(parameter.before) && is_digest(parameter.after));
    });
    append(changes, std::move(told));
    append(changes, std::move(parameters));
  }
  append(changes, input_changes(now, last));
  if (changes.empty()) changes.push_back({Kind::Order});
  return changes;
}

std::string to_text(const KeyChange& change) {
  switch (change.kind) {
    case Kind::NeverRun:
      return "never run";
    case Kind::EntryLost:
      return "its cache entry is missing or damaged";
    case Kind::Forgotten:
      return "its last run is no longer in the cache";
    case Kind::Tool:
      return "the tool changed";
    case Kind::Version:
      return fmt::format("stage version {} -> {}", *change.before, *change.after);
    case Kind::Setting:
      return fmt::format("{}: {} -> {}", change.name, value_text(change.before), value_text(change.after));
    case Kind::Parameter:
      if (!change.before) return fmt::format("parameter {} is new: {}", change.name, *change.after);
      if (!change.after) return fmt::format("parameter {} is gone", change.name);
      return fmt::format("parameter {}: {} -> {}", change.name, *change.before, *change.after);
    case Kind::Input:
      if (!change.after) return fmt::format("input {} is gone", change.name);
      return fmt::format("input {} {}", change.name, change.before ? "changed" : "is new");
    case Kind::Pending:
      return fmt::format("input {} is made first", change.name);
    case Kind::Order:
      return "the order of its inputs changed";
  }
  return {};
}

std::string why_run(std::span<const KeyChange> changes) {
  std::vector<std::string> reasons;
  for (const KeyChange& change : changes.first(std::min(changes.size(), kMaxReasons)))
    reasons.push_back(to_text(change));
  const std::size_t left_out = changes.size() - reasons.size();
  return fmt::format("{}{}", fmt::join(reasons, "; "), left_out ? fmt::format("; {} more", left_out) : "");
}

}  // namespace skinforge
