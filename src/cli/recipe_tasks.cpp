#include "cli/recipe_tasks.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "base/text.h"
#include "recipe/recipe_file.h"

namespace skinforge {
namespace fs = std::filesystem;

namespace {
// Whether a file in a folder is a recipe of its own; one that cannot be read is, so that it is told.
bool is_recipe(const fs::path& path) {
  const std::string extension = path.extension().string(), name = path.filename().string();
  const bool has_form =
      extension == ".json" || extension == ".jsonc" || extension == ".yaml" || extension == ".yml";
  if (!has_form || name.starts_with('_') || name.starts_with('.')) return false;
  try {
    const Value root = read_value_file(path);
    return root.find("recipe_version") || root.find("extends");
  } catch (const Error&) {
    return true;
  }
}

std::vector<std::string> recipe_files(const std::vector<std::string>& named) {
  std::vector<std::string> files;
  for (const std::string& path : named) {
    std::error_code error;
    if (!fs::is_directory(path, error)) {
      files.push_back(path);
      continue;
    }
    std::vector<std::string> inside;
    for (const auto& item : fs::directory_iterator(path))
      if (item.is_regular_file() && is_recipe(item.path())) inside.push_back(item.path().string());
    if (inside.empty()) throw Error(ExitCode::Usage, path + ": no recipe in this folder");
    std::sort(inside.begin(), inside.end());
    files.insert(files.end(), inside.begin(), inside.end());
  }
  return files;
}

void add_tasks(const std::string& file, const RecipeChoice& choice, std::vector<RecipeTask>& tasks) {
  try {
    for (ResolvedRecipe& resolved : resolve_recipes(file, choice))
      tasks.push_back({file, std::move(resolved), ExitCode::Ok, {}});
  } catch (const Error& error) {
    tasks.push_back({file, {}, error.code(), error.what()});
  }
}

// "2/5": the second of five.
std::pair<std::size_t, std::size_t> shard_of(const std::string& text) {
  std::size_t index = 0, count = 0;
  char end = 0;
  if (std::sscanf(text.c_str(), "%zu/%zu%c", &index, &count, &end) != 2 || index < 1 || index > count)
    throw Error(ExitCode::Usage, fmt::format("--shard {}: expected I/N with I from 1 to N", printable(text)));
  return {index, count};
}
}  // namespace

std::string RecipeTask::label() const {
  return resolved.variant.empty() ? recipe : recipe + " " + resolved.variant;
}

std::vector<RecipeTask> recipe_tasks(const CommandLine& line) {
  std::vector<RecipeTask> tasks;
  for (const std::string& file : recipe_files(line.recipes)) add_tasks(file, line.choice, tasks);
  if (line.shard.empty()) return tasks;
  const auto [index, count] = shard_of(line.shard);
  std::vector<RecipeTask> mine;
  for (std::size_t i = index - 1; i < tasks.size(); i += count) mine.push_back(std::move(tasks[i]));
  return mine;
}

ResolvedRecipe only_recipe(const CommandLine& line) {
  std::vector<ResolvedRecipe> recipes = resolve_recipes(line.recipes.front(), line.choice);
  if (recipes.size() == 1) return std::move(recipes.front());
  std::string cells;
  for (const ResolvedRecipe& recipe : recipes) cells += (cells.empty() ? "" : " or ") + recipe.variant;
  throw Error(ExitCode::Usage, fmt::format("{}: this recipe makes {} characters; choose one with --only {}",
                                           line.recipes.front(), recipes.size(), cells));
}

}  // namespace skinforge
