#include <fmt/core.h>

#include "base/safe_name.h"
#include "base/text.h"
#include "recipe/recipe.h"
#include "recipe/recipe_files.h"
#include "recipe/recipe_parts.h"
#include "recipe/recipe_places.h"
#include "recipe/recipe_values.h"
#include "recipe/resolve.h"

namespace skinforge {
namespace fs = std::filesystem;

namespace {
constexpr std::size_t kMaxIncludeDepth = 16;  // ours: recipes in recipes in recipes
const std::initializer_list<std::string_view> kKeys = {
    "$schema", "recipe_version", "name",        "inputs", "base",  "ops",
    "surface", "animation",      "correctives", "output", "expect"};

const char* hint_for(const Value& version) {
  if (version.kind != Value::Kind::Number) return "";
  return version.number > kRecipeVersion ? "; a newer skinforge reads it" : "; skinforge migrate rewrites it";
}

void expect_version(const ValueReader& reader) {
  for (const auto& [key, value] : reader.members()) {
    if (key != "recipe_version") continue;
    if (value.number() == kRecipeVersion) return;
    value.fail(fmt::format("expected recipe version {}, found {}{}", kRecipeVersion, value.value().describe(),
                           hint_for(value.value())));
  }
  reader.object(kKeys);
  reader.fail(
      fmt::format("missing key \"recipe_version\" (this tool reads version {}; skinforge migrate brings "
                  "older recipes to it)",
                  kRecipeVersion));
}

std::string safe_name(const ValueReader& reader) {
  const std::string name = reader.text();
  if (!is_safe_file_name(name))
    reader.fail(
        fmt::format("\"{}\" cannot be a file name; take letters, digits and . _ - +", printable(name)));
  return name;
}

// Reads one recipe file; `including` are the files that led here, outermost first.
class RecipeReader {
 public:
  RecipeReader(const fs::path& path, const std::vector<fs::path>& including,
               const std::vector<std::string>& inputs_under)
      : path_(path), including_(including), inputs_under_(inputs_under) {}

  Recipe read(const ResolvedRecipe& resolved) const {
    const std::string file = path_.string();
    const ValueReader reader(resolved.root, file, "");
    expect_version(reader);
    const ObjectReader object = reader.object(kKeys);
    if (const auto schema = object.find("$schema")) schema->text();
    Recipe recipe;
    recipe.path = path_;
    recipe.variant = resolved.variant;
    recipe.name = safe_name(object.at("name"));
    recipe.inputs = read_inputs(object.at("inputs"), [this](const ValueReader& named, const fs::path& path) {
      return included(named, path);
    });
    recipe.base = input_name(object.at("base"), recipe.inputs);
    if (const auto surface = object.find("surface")) read_surface(*surface, recipe.surface);
    if (const auto ops = object.find("ops")) recipe.operations = read_operations(*ops, recipe);
    if (const auto animation = object.find("animation")) recipe.animation = read_animation(*animation);
    if (const auto correctives = object.find("correctives"))
      recipe.correctives = read_correctives(*correctives, recipe);
    if (const auto output = object.find("output")) recipe.output = read_output(*output);
    if (recipe.output.glb.empty()) recipe.output.glb = recipe.name + ".glb";
    if (const auto expect = object.find("expect")) read_expectations(*expect, recipe);
    add_places_and_values(resolved.root, recipe);
    return recipe;
  }

 private:
  Recipe included(const ValueReader& reader, const fs::path& path) const;

  fs::path path_;
  std::vector<fs::path> including_;
  std::vector<std::string> inputs_under_;
};

// The one recipe of a file that another recipe or the program asks for.
Recipe read_only_one(std::vector<ResolvedRecipe> recipes, const fs::path& path,
                     const std::vector<fs::path>& including) {
  if (recipes.size() != 1)
    throw Error(ExitCode::Usage, fmt::format("{}: this recipe makes {} characters; one is wanted here",
                                             path.string(), recipes.size()));
  return RecipeReader(path, including, recipes.front().inputs_under).read(recipes.front());
}

Recipe RecipeReader::included(const ValueReader& reader, const fs::path& path) const {
  std::vector<fs::path> chain = including_;
  chain.push_back(path_);
  std::error_code error;
  for (const fs::path& file : chain)
    if (fs::equivalent(file, path, error))
      reader.fail("recipe \"" + printable(path.string()) + "\" includes itself");
  if (chain.size() > kMaxIncludeDepth)
    reader.fail(fmt::format("recipes inside each other deeper than {}", kMaxIncludeDepth));
  if (!inputs_under_.empty() && !lies_under(path, inputs_under_))
    reader.fail(fmt::format("{} is not below a folder of --inputs-under", printable(path.string())));
  return read_only_one(resolve_recipes(path, {.inputs_under = inputs_under_}), path, chain);
}
}  // namespace

Recipe read_resolved(const ResolvedRecipe& resolved) {
  return RecipeReader(resolved.path, {}, resolved.inputs_under).read(resolved);
}

Recipe load_recipe(const fs::path& path) {
  return read_only_one(resolve_recipes(path), path, {});
}

Recipe parse_recipe(const std::string& text, const fs::path& path) {
  return read_only_one(resolve_text(text, path), path, {});
}

}  // namespace skinforge
