#pragma once

#include <filesystem>
#include <vector>

#include "recipe/recipe.h"

namespace skinforge {

/// Model, clip, skeleton and example files that a recipe names, those of recipes inside it too.
std::vector<std::filesystem::path> input_files(const Recipe& recipe);

/// Characters that results are compared with, those of recipes inside it too. They may not be there yet.
std::vector<std::filesystem::path> golden_files(const Recipe& recipe);

/// The recipe files themselves: this one and those inside it.
std::vector<std::filesystem::path> recipe_files(const Recipe& recipe);

/// All of these: what a build reads and must not overwrite.
std::vector<std::filesystem::path> all_files(const Recipe& recipe);

/// Whether the file, links followed, lies below one of the folders. Throws Error (Usage) for a folder that is
/// none.
bool lies_under(const std::filesystem::path& file, const std::vector<std::string>& folders);

}  // namespace skinforge
