#pragma once

#include <string>
#include <vector>

#include "cli/command_line.h"
#include "recipe/resolve.h"

namespace skinforge {

/// One character to be made, or why it cannot be.
struct RecipeTask {
  std::string recipe;       ///< file, as the person named it
  ResolvedRecipe resolved;  ///< empty where there is an error
  ExitCode code = ExitCode::Ok;
  std::string error;

  /// "recipes/centaur.json", with the cell of its matrix behind it.
  std::string label() const;
};

/// All characters that the recipes of the command line make: files in the order given, folders as the recipes
/// in them by name (not those below; files without "recipe_version" and "extends", and those that start with
/// _ or a dot, are parts of others), a matrix as its cells; then the shard of them that is asked for. A
/// recipe that cannot be read is one task with an error.
std::vector<RecipeTask> recipe_tasks(const CommandLine& line);

/// The one recipe of commands that take one. Throws Error (Usage) where it makes several.
ResolvedRecipe only_recipe(const CommandLine& line);

}  // namespace skinforge
