#include "recipe/recipe_files.h"

#include <algorithm>

#include "base/text.h"

namespace skinforge {
namespace fs = std::filesystem;

namespace {
void append(std::vector<fs::path>& files, std::vector<fs::path> more) {
  files.insert(files.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}
}  // namespace

std::vector<fs::path> input_files(const Recipe& recipe) {
  std::vector<fs::path> files;
  for (const RecipeInput& input : recipe.inputs) {
    if (input.recipe)
      append(files, input_files(*input.recipe));
    else
      files.push_back(input.file.resolved);
    for (const RecipePath& clips : input.clips) files.push_back(clips.resolved);
    if (input.bind)
      for (const RecipePath& path : {input.bind->skeleton, input.bind->handle_file})
        if (!path.text.empty()) files.push_back(path.resolved);
  }
  for (const RecipeExample& example : recipe.correctives.examples) {
    files.push_back(example.shape.resolved);
    files.push_back(example.pose.resolved);
  }
  return files;
}

std::vector<fs::path> golden_files(const Recipe& recipe) {
  std::vector<fs::path> files;
  if (recipe.golden) files.push_back(recipe.golden->file.resolved);
  for (const RecipeInput& input : recipe.inputs)
    if (input.recipe) append(files, golden_files(*input.recipe));
  return files;
}

std::vector<fs::path> recipe_files(const Recipe& recipe) {
  std::vector<fs::path> files{recipe.path};
  for (const RecipeInput& input : recipe.inputs)
    if (input.recipe) append(files, recipe_files(*input.recipe));
  return files;
}

std::vector<fs::path> all_files(const Recipe& recipe) {
  std::vector<fs::path> files = input_files(recipe);
  append(files, recipe_files(recipe));
  append(files, golden_files(recipe));
  return files;
}

bool lies_under(const fs::path& file, const std::vector<std::string>& folders) {
  return std::any_of(folders.begin(), folders.end(), [&](const std::string& folder) {
    std::error_code error;
    if (!fs::is_directory(folder, error))
      throw Error(ExitCode::Usage, printable(folder) + ": --inputs-under names no folder");
    const fs::path below = fs::weakly_canonical(file).lexically_relative(fs::canonical(folder));
    return !below.empty() && *below.begin() != "..";
  });
}

}  // namespace skinforge
