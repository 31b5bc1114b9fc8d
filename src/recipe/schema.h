#pragma once

#include <string>

namespace skinforge {

/// JSON Schema (draft-07) of recipes, as `skinforge schema` prints it and `schemas/recipe.schema.json` holds
/// it: description, default, unit and example of every property. Defaults come from the structs of recipe.h.
/// What a schema cannot say (names that refer to each other, device names) only `load_recipe` checks.
std::string recipe_schema();

}  // namespace skinforge
