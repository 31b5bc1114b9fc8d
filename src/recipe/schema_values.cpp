#include "recipe/schema_values.h"

#include <nlohmann/json.hpp>

namespace skinforge::schema {

Json closed_object(Json properties) {
  return {{"type", "object"}, {"properties", std::move(properties)}, {"additionalProperties", false}};
}

Json closed_object(Json properties, Json required) {
  Json schema = closed_object(std::move(properties));
  schema["required"] = std::move(required);
  return schema;
}

Json described(const std::string& description, Json schema, Json examples) {
  schema["description"] = description;
  schema["examples"] = std::move(examples);
  return schema;
}

Json with_default(Json schema, Json value) {
  schema["default"] = std::move(value);
  return schema;
}

Json optional(const std::string& description, Json schema, Json examples) {
  Json with_null = {{"anyOf", {schema, {{"type", "null"}}}}, {"default", nullptr}};
  if (schema.contains("unit")) with_null["unit"] = schema["unit"];
  return described(description, std::move(with_null), std::move(examples));
}

Json text() {
  return {{"type", "string"}, {"minLength", 1}};
}

Json number(double least, double most, const char* unit) {
  return {{"type", "number"}, {"minimum", least}, {"maximum", most}, {"unit", unit}};
}

Json vector3(const char* unit) {
  return {{"type", "array"},
          {"items", number(-1e9, 1e9, unit)},
          {"minItems", 3},
          {"maxItems", 3},
          {"unit", unit}};
}

Json path() {
  return {{"type", "string"}, {"pattern", kPath}};
}

Json joints() {
  return {
      {"anyOf", {text(), {{"type", "array"}, {"items", text()}, {"minItems", 1}, {"uniqueItems", true}}}}};
}

Json clip_names() {
  return {{"type", "array"}, {"items", text()}, {"uniqueItems", true}};
}

Json all_or_names() {
  return {{"anyOf", {{{"type", "string"}, {"enum", {"all"}}}, clip_names()}}};
}

}  // namespace skinforge::schema
