#include "recipe/schema_properties.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "recipe/schema.h"
#include "recipe/value_reader.h"

namespace skinforge {

namespace {
using Json = nlohmann::ordered_json;

std::optional<std::string> member_text(const Json& schema, const char* key) {
  if (!schema.contains(key)) return std::nullopt;
  return schema.at(key).is_string() && std::string_view(key) != "default" ? schema.at(key).get<std::string>()
                                                                          : schema.at(key).dump();
}

void collect(const Json& schema, const std::string& pointer, std::vector<SchemaProperty>& found);

void add_property(const std::string& pattern, const Json& schema, std::vector<SchemaProperty>& found) {
  const bool is_known =
      std::any_of(found.begin(), found.end(), [&](const auto& p) { return p.pattern == pattern; });
  if (is_known) return;
  SchemaProperty property{.pattern = pattern};
  property.description = member_text(schema, "description").value_or("");
  property.preset = member_text(schema, "default");
  property.unit = member_text(schema, "unit");
  for (const Json& example : schema.value("examples", Json::array()))
    property.examples.push_back(example.dump());
  found.push_back(std::move(property));
}

// Below `pointer`: what an object's members, a list's items and the alternatives of a value may be.
void collect(const Json& schema, const std::string& pointer, std::vector<SchemaProperty>& found) {
  if (!schema.is_object()) return;
  if (schema.contains("properties") && schema.contains("type"))  // not those of a condition
    for (const auto& [key, property] : schema.at("properties").items()) {
      const std::string pattern = pointer_to(pointer, key);
      add_property(pattern, property, found);
      collect(property, pattern, found);
    }
  for (const char* key : {"items", "additionalProperties"})
    if (schema.contains(key)) collect(schema.at(key), pointer + "/*", found);
  for (const char* key : {"anyOf", "oneOf"})
    if (schema.contains(key))
      for (const Json& alternative : schema.at(key)) collect(alternative, pointer, found);
}

std::string_view take_step(std::string_view& pointer) {
  const auto end = pointer.find('/', 1);
  const std::string_view step = pointer.substr(0, end);
  pointer = end == std::string_view::npos ? std::string_view() : pointer.substr(end);
  return step;
}
}  // namespace

const std::vector<SchemaProperty>& schema_properties() {
  static const std::vector<SchemaProperty> properties = [] {
    std::vector<SchemaProperty> found;
    collect(Json::parse(recipe_schema()), "", found);
    return found;
  }();
  return properties;
}

bool matches_pattern(std::string_view pattern, std::string_view pointer) {
  while (!pattern.empty() && !pointer.empty()) {
    const std::string_view wanted = take_step(pattern), step = take_step(pointer);
    if (wanted != "/*" && wanted != step) return false;
  }
  return pattern.empty() && pointer.empty();
}

std::optional<std::string> default_text(const std::string& pointer) {
  for (const SchemaProperty& property : schema_properties())
    if (matches_pattern(property.pattern, pointer)) {
      constexpr std::string_view kOfOperation = "/ops/*";
      if (!property.preset && property.pattern.starts_with("/ops/*/surface/"))  // the recipe's
        return default_text(property.pattern.substr(kOfOperation.size()));
      return property.preset;
    }
  return std::nullopt;
}

}  // namespace skinforge
