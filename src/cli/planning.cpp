#include "cli/planning.h"

#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "base/text.h"
#include "recipe/schema_properties.h"
#include "stages/build.h"
#include "stages/stage_settings.h"

namespace skinforge {
using nlohmann::json;
using Kind = KeyChange::Kind;

namespace {
const char* kind_name(Kind kind) {
  switch (kind) {
    case Kind::NeverRun:
      return "never-run";
    case Kind::EntryLost:
      return "entry-lost";
    case Kind::Forgotten:
      return "forgotten";
    case Kind::Tool:
      return "tool";
    case Kind::Version:
      return "version";
    case Kind::Setting:
      return "setting";
    case Kind::Parameter:
      return "parameter";
    case Kind::Input:
      return "input";
    case Kind::Pending:
      return "pending";
    case Kind::Order:
      return "order";
  }
  return "";
}

// The property of the recipe that the change comes from; empty when there is none.
std::string setting_of(const KeyChange& change) {
  if (change.kind == Kind::Setting) return change.name;
  return change.kind == Kind::Input ? setting_of_source(change.name).value_or("") : "";
}

// A value that the recipe does not set, as what it is then.
std::optional<std::string> with_default(const std::optional<std::string>& value, const std::string& setting) {
  if (value) return value;
  const auto preset = default_text(setting);
  if (!preset) return std::nullopt;
  return (*preset == "null" ? "not set" : *preset) + " (default)";
}

std::string value_text(const std::optional<std::string>& value) {
  return value ? printable(*value) : "(not set)";
}

std::string short_digest(const std::optional<std::string>& hex) {
  return hex ? hex->substr(0, 12) : "(none)";
}
}  // namespace

RecipePlan plan_recipe(Session& session) {
  RecipePlan plan;
  plan.is_complete = session.plan_import();
  if (plan.is_complete) session.add_grafts();
  plan.stages = session.engine().plan();
  return plan;
}

const char* state_name(PlanState state) {
  switch (state) {
    case PlanState::Hit:
      return "hit";
    case PlanState::Run:
      return "run";
    case PlanState::Waits:
      return "waits";
  }
  return "";
}

std::string place_of(const KeyChange& change, const Recipe& recipe) {
  const std::string setting = setting_of(change);
  return setting.empty() ? std::string() : recipe.where(setting);
}

std::string sentence(const KeyChange& change, const Recipe& recipe) {
  const std::string place = place_of(change, recipe);
  const std::string at = place.empty() ? "" : fmt::format(" ({})", place);
  switch (change.kind) {
    case Kind::Setting:
      return fmt::format("{}: {} -> {}{}", printable(change.name),
                         value_text(with_default(change.before, change.name)),
                         value_text(with_default(change.after, change.name)), at);
    case Kind::Tool:
      return fmt::format("the tool changed: {} -> {}", value_text(change.before), value_text(change.after));
    case Kind::Input:
      return fmt::format("{} {}: {} -> {}{}", at.empty() ? "input" : "file", printable(change.name),
                         short_digest(change.before), short_digest(change.after), at);
    default:
      return printable(to_text(change));
  }
}

json to_json(const std::vector<KeyChange>& changes, const Recipe& recipe) {
  json list = json::array();
  for (const KeyChange& change : changes) {
    json item = {{"kind", kind_name(change.kind)}};
    if (!change.name.empty()) item["name"] = change.name;
    const bool is_setting = change.kind == Kind::Setting;
    const auto before = is_setting ? with_default(change.before, change.name) : change.before;
    const auto after = is_setting ? with_default(change.after, change.name) : change.after;
    if (before) item["before"] = *before;
    if (after) item["after"] = *after;
    if (const std::string place = place_of(change, recipe); !place.empty()) item["place"] = place;
    list.push_back(std::move(item));
  }
  return list;
}

}  // namespace skinforge
