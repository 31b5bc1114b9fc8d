#pragma once

#include <filesystem>
#include <vector>

#include "recipe/recipe.h"

namespace skinforge {

/// Model, clip, skeleton and example files that a recipe names, those of recipes inside it too.
std::vector<std::filesystem::path> input_files(const Recipe& recipe);

/// The recipe files themselves: this one and those inside it.
std::vector<std::filesystem::path> recipe_files(const Recipe& recipe);

}  // namespace skinforge
