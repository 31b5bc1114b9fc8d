#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/expect.h"
#include "base/safe_name.h"
#include "fuzz/input.h"
#include "recipe/recipe.h"
#include "recipe/recipe_file.h"
#include "recipe/recipe_files.h"
#include "recipe/resolve.h"
#include "testing/temporary_folder.h"

namespace skinforge::fuzz {

/// The recipes of the repository in a folder of their own, to which files are added for one input.
class RecipeFolder {
 public:
  RecipeFolder() {
    const std::filesystem::path repository = std::filesystem::path(SKINFORGE_SOURCE_DIR);
    std::filesystem::copy(repository / "recipes", folder_ / "recipes");
    std::filesystem::create_directory_symlink(repository / "data", folder_ / "data");
  }

  std::filesystem::path path(const std::string& name) const { return folder_ / "recipes" / name; }

  /// Unless a file of the repository has that name.
  void add(const std::string& name, const std::string& text) {
    if (!is_safe_file_name(name) || std::filesystem::exists(path(name))) return;
    std::ofstream(path(name), std::ios::binary) << text;
    added_.push_back(name);
  }

  void clear() {
    for (const std::string& name : added_) std::filesystem::remove(path(name));
    added_.clear();
  }

 private:
  testing::TemporaryFolder folder_;
  std::vector<std::string> added_;
};

/// A recipe, files beside it, and words of the command line in one text: a line "=== NAME" begins the file of
/// that name, "=== --set" and "=== --only" begin words, one a line.
struct RecipeInputText {
  std::string recipe;
  std::vector<std::pair<std::string, std::string>> files;
  RecipeChoice choice;

  explicit RecipeInputText(const std::string& text) {
    constexpr std::string_view kMark = "=== ";
    std::istringstream lines(text);
    std::string* file = &recipe;
    std::vector<std::string>* words = nullptr;
    for (std::string line; std::getline(lines, line);) {
      if (!line.starts_with(kMark)) {
        words ? words->push_back(line) : void(*file += line + "\n");
        continue;
      }
      const std::string name = line.substr(kMark.size());
      words = name == "--set" ? &choice.set : name == "--only" ? &choice.only : nullptr;
      if (!words) file = &files.emplace_back(name, "").second;
    }
  }
};

inline void follow(const ResolvedRecipe& resolved) {
  const std::string json = plain_json(resolved.root);
  SF_EXPECT(plain_json(parse_value_text(json, "again.json")) == json);
  expanded_text(resolved.root);
  const Recipe recipe = read_resolved(resolved);
  recipe_files(recipe);
  input_files(recipe);
  recipe_digest(recipe);
  for (const auto& [pointer, text] : recipe_settings(recipe)) recipe.place(pointer);
}

inline void feed_recipe(std::span<const std::byte> bytes, const char* name) {
  constexpr std::size_t kMaxFiles = 8, kMaxCells = 20;  // more only take time
  static RecipeFolder folder;
  RecipeInputText input(text_of(bytes));
  folder.clear();
  for (std::size_t i = 0; i < std::min(input.files.size(), kMaxFiles); ++i)
    folder.add(input.files[i].first, input.files[i].second);
  const auto recipes = resolve_text(input.recipe, folder.path(name), input.choice);
  for (std::size_t i = 0; i < std::min(recipes.size(), kMaxCells); ++i) follow(recipes[i]);
}

inline void feed_recipe_json(std::span<const std::byte> bytes) {
  feed_recipe(bytes, "fuzz.json");
}

inline void feed_recipe_yaml(std::span<const std::byte> bytes) {
  feed_recipe(bytes, "fuzz.yaml");
}

}  // namespace skinforge::fuzz
