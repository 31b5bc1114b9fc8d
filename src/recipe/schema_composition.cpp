#include <nlohmann/json.hpp>

#include "recipe/recipe.h"
#include "recipe/schema_parts.h"
#include "recipe/schema_values.h"

namespace skinforge::schema {

namespace {
// What any value but a name of a file may be instead: a reference to a variable.
Json reference() {
  return {{"type", "string"}, {"pattern", R"(\$\{[^}]+\})"}};
}

bool takes_references(const Json& schema) {
  if (!schema.contains("type")) return schema.contains("enum");
  const Json& type = schema.at("type");
  if (type == "string") return schema.contains("pattern") || schema.contains("enum");
  return type == "number" || type == "integer" || type == "boolean" || type == "array";
}

Json include_path() {
  return described(
      "A value from another file, laid under the members beside it: file.json, or "
      "file.json#/pointer.",
      {{"type", "string"}, {"minLength", 1}}, {"limbs.json#/ops/0"});
}

Json included() {
  return {{"type", "object"}, {"required", {"include"}}, {"properties", {{"include", include_path()}}}};
}
}  // namespace

Json variables() {
  const Json plain = {{"type", {"string", "number", "boolean", "array"}}};
  const Json limit = {{"type", "number"}, {"unit", "that of the variable"}};
  const Json declared = closed_object(
      {{"type", described("What it may be; by default what `default` is.",
                          {{"type", "string"}, {"enum", {"string", "number", "integer", "boolean", "list"}}},
                          {"number"})},
       {"default", described("Its value unless --set gives another.",
                             {{"type", {"string", "number", "boolean", "array"}}}, {1.2})},
       {"choices", described("The values it may have.", {{"type", "array"}, {"minItems", 1}},
                             Json::array({Json::array({"L", "R"})}))},
       {"min", described("The least number.", limit, {0})},
       {"max", described("The largest number.", limit, {2})},
       {"description", described("What it is for.", {{"type", "string"}}, {"Size of the rider."})}},
      {"default"});
  return {{"type", "object"}, {"additionalProperties", {{"anyOf", {plain, declared}}}}};
}

Json matrix() {
  const Json cells = {{"type", "array"}, {"items", {{"type", "object"}}}};
  return {{"type", "object"},
          {"properties",
           {{"include", described("Further cells: a value for every axis, and variables of their own.", cells,
                                  {{{{"body", "fox"}, {"torso", "knight"}}}})},
            {"exclude", described("Combinations to leave out.", cells, {{{{"body", "wolf"}}}})}}},
          {"additionalProperties", {{"type", "array"}, {"minItems", 1}}}};
}

void open_up(Json& schema) {
  if (!schema.is_object()) return;
  if (schema.contains("properties") && schema.contains("type"))
    for (auto& [key, property] : schema.at("properties").items()) open_up(property);
  for (const char* key : {"items", "additionalProperties"})
    if (schema.contains(key)) open_up(schema.at(key));
  for (const char* key : {"anyOf", "oneOf"})
    if (schema.contains(key))
      for (Json& alternative : schema.at(key)) open_up(alternative);
  const bool is_object = schema.contains("type") && schema.at("type") == "object";
  if (!is_object && !takes_references(schema)) return;
  Json rules = Json::object(), said = Json::object();
  for (const auto& [key, value] : schema.items()) {
    const bool is_said = key == "description" || key == "default" || key == "examples" || key == "unit";
    (is_said ? said : rules)[key] = value;
  }
  if (is_object) rules["properties"]["include"] = include_path();  // so that editors offer it
  said["anyOf"] = Json::array({std::move(rules), is_object ? included() : reference()});
  schema = std::move(said);
}

}  // namespace skinforge::schema
