#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

/// Parts that schemas of a recipe's members are made of.
namespace skinforge::schema {
using Json = nlohmann::ordered_json;

constexpr const char* kFileName = "^(?=.{1,120}$)[A-Za-z0-9_+]([A-Za-z0-9._+ -]*[A-Za-z0-9_+-])?$";
constexpr const char* kPath = R"(^(?![A-Za-z]+:\/\/)[^\/\\\x00-\x1f][^\\\x00-\x1f]*$)";

/// An object of these properties and no others; `required` names those it must have.
Json closed_object(Json properties);
Json closed_object(Json properties, Json required);
Json described(const std::string& description, Json schema, Json examples);
Json with_default(Json schema, Json value);
/// May be null, which is the default and means what `description` says for its absence.
Json optional(const std::string& description, Json schema, Json examples);

/// A string that is not empty.
Json text();
Json number(double least, double most, const char* unit);
Json vector3(const char* unit);
/// A path as `read_path` takes it.
Json path();
/// One joint or several.
Json joints();
Json clip_names();
/// "all", or names of clips.
Json all_or_names();

}  // namespace skinforge::schema
