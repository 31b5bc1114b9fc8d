#pragma once

#include <filesystem>
#include <string>

#include "recipe/value_tree.h"

namespace skinforge {

/// A recipe file as a tree whose values know their file, whatever the form (.json, .jsonc, .yaml, .yml).
/// Throws Error: BadInput when it cannot be read, Usage when it is no text of that form.
Value read_value_file(const std::filesystem::path& path);

/// The same from text in hand.
Value parse_value_text(const std::string& text, const std::filesystem::path& path);

/// The text of a recipe file. Throws Error: BadInput when it cannot be read, Usage when it is too large.
std::string read_recipe_text(const std::filesystem::path& path);

}  // namespace skinforge
