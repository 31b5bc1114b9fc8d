#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "recipe/recipe.h"
#include "recipe/value_tree.h"

namespace skinforge {

/// What the command line asks of a recipe.
struct RecipeChoice {
  std::vector<std::string> set = {};   ///< "scale=1.2": a variable; "/output/influences=8": any property
  std::vector<std::string> only = {};  ///< "torso=knight": cells of the matrix with that value
  /// Folders below which everything lies that a recipe names; empty: anywhere. Recipes and parts of them
  /// elsewhere are not read; of models `lies_under` says it.
  std::vector<std::string> inputs_under = {};
};

/// One recipe with everything settled: no extends, include, vars, matrix or ${...} are left.
struct ResolvedRecipe {
  std::filesystem::path path;
  std::string variant;  ///< cell of the matrix, "body=horse torso=knight"; empty without one
  Value root;           ///< values know where they come from
  std::vector<std::string> inputs_under = {};  ///< as chosen; recipes inside it are held to it, too
};

/// All recipes of a file, in the order of its matrix (the last axis fastest, then what "include" adds);
/// without one, a single one. Throws Error like `load_recipe` for what concerns them all: unreadable files,
/// circles, unknown variables, two cells of one name. What is wrong with one of them `read_resolved` says.
std::vector<ResolvedRecipe> resolve_recipes(const std::filesystem::path& path,
                                            const RecipeChoice& choice = {});
/// The same where the text is in hand.
std::vector<ResolvedRecipe> resolve_text(const std::string& text, const std::filesystem::path& path,
                                         const RecipeChoice& choice = {});

/// The recipe as plain data. Throws Error (Usage) like `load_recipe`.
Recipe read_resolved(const ResolvedRecipe& resolved);

/// JSON with comments: each value with its origin behind it, "// base.json:12:9".
std::string expanded_text(const Value& root);
/// The tree as JSON, without comments.
std::string plain_json(const Value& root);

}  // namespace skinforge
