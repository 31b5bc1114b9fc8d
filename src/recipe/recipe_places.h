#pragma once

#include "recipe/recipe.h"
#include "recipe/value_tree.h"

namespace skinforge {

/// Notes in `recipe` where each value of `root` stands, and what it is, by JSON pointer.
void add_places_and_values(const Value& root, Recipe& recipe);

}  // namespace skinforge
