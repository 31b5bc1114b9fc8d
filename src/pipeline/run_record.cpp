#include "pipeline/run_record.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <span>

#include "pipeline/json_number.h"

namespace skinforge {
using nlohmann::json;

const Settings& RunRecord::settings_of(const std::string& label) const {
  static const Settings kNone;
  const auto stage = stages.find(label);
  return stage != stages.end() && stage->second.settings < settings.size() ? settings[stage->second.settings]
                                                                           : kNone;
}

void RunRecord::note(const std::string& label, const Digest& key, const Settings& now) {
  const auto known = stages.find(label);
  if (known != stages.end() && known->second.key == key) return;  // the settings that gave the key stay
  const auto same = std::find(settings.begin(), settings.end(), now);
  const auto index = static_cast<std::size_t>(same - settings.begin());
  if (same == settings.end()) settings.push_back(now);
  stages[label] = {key, index};
}

void RunRecord::tidy() {
  std::set<std::size_t> used;
  for (const auto& [label, stage] : stages) used.insert(stage.settings);
  std::vector<Settings> kept;
  std::map<std::size_t, std::size_t> moved;
  for (const std::size_t index : used) {
    if (index >= settings.size()) continue;
    moved[index] = kept.size();
    kept.push_back(std::move(settings[index]));
  }
  for (auto& [label, stage] : stages)
    if (const auto to = moved.find(stage.settings); to != moved.end()) stage.settings = to->second;
  settings = std::move(kept);
}

std::string RunRecord::id() const {
  const std::string text = run_record_text(*this);
  return sha256(std::as_bytes(std::span(text))).hex().substr(0, 8);
}

std::string run_record_text(const RunRecord& record) {
  json stages = json::object();
  for (const auto& [label, stage] : record.stages) stages[label] = {stage.key.hex(), stage.settings};
  return json{{"stages", std::move(stages)}, {"settings", record.settings}}.dump(
      -1, ' ', false, json::error_handler_t::replace);
}

std::optional<RunRecord> parse_run_record(std::string_view text) {
  try {
    const json document = json::parse(text, nullptr, false);
    if (!document.is_object()) return std::nullopt;
    RunRecord record;
    record.settings = document.at("settings").get<std::vector<Settings>>();
    for (const auto& [label, stage] : document.at("stages").items()) {
      const auto key = digest_from_hex(stage.at(0).get<std::string>());
      if (!key) return std::nullopt;
      record.stages[label] = {*key, whole_number(stage.at(1))};
    }
    return record;
  } catch (const json::exception&) {
    return std::nullopt;
  } catch (const Error&) {
    return std::nullopt;
  }
}

}  // namespace skinforge
