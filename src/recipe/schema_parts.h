#pragma once

#include <nlohmann/json_fwd.hpp>

/// The schema of each member of a recipe, in a file of its own (schema_<member>.cpp), as recipe_parts.h reads
/// them.
namespace skinforge::schema {
using Json = nlohmann::ordered_json;

Json inputs();
Json operation();
/// `with_defaults`: of the recipe; an operation takes the recipe's where it does not say otherwise.
Json surface(bool with_defaults);
Json animation();
Json correctives();
Json output();
Json expect();
Json variables();
Json matrix();

/// Lets each value of a recipe be a reference to a variable, and each object one from another file. What is
/// said about the property (description, default, unit, examples) stays where it is.
void open_up(Json& schema);

}  // namespace skinforge::schema
