#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "recipe/value_tree.h"

namespace skinforge {

/// A recipe brought to the version that this tool reads.
struct Migration {
  std::string text;                       ///< of the file; as it was where nothing had to change
  std::vector<std::string> changes = {};  ///< one line each: "centaur.json:3:5: /inputs/horse/root: ..."
};

/// Rewrites the text of a recipe from an older version to `kRecipeVersion`: only what changes, so that
/// comments, order and layout stay. JSON with comments and YAML, by the ending of `path`. Versions:
///  - 0, without "recipe_version": the first drafts. An input had a "root", which nothing read; it goes.
///    "blend" of a replace might say "union" and that of an attach "blend", which changed nothing; they
///    become "auto". The version is written where the file is a whole recipe; parts of others have none.
///  - 1: the present one. What drafts said stays wrong there, and goes likewise.
/// Files that the recipe extends or includes are not touched. What was written is read again and compared.
/// Throws Error (Usage) for a version that is newer, text that is no recipe, and a layout that cannot be
/// changed in place.
Migration migrate_recipe(const std::string& text, const std::filesystem::path& path);

}  // namespace skinforge
