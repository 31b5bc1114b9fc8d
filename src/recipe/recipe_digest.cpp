#include "recipe/recipe.h"

namespace skinforge {

Digest recipe_digest(const Recipe& recipe) {
  Hasher hasher;
  hasher.add("name", recipe.name);
  hasher.add("base", recipe.base);
  for (const RecipeInput& input : recipe.inputs) {
    hasher.add("input", input.name);
    hasher.add_value("pose", input.pose);
    hasher.add_value("clip files", static_cast<std::uint64_t>(input.clips.size()));
    if (input.bind) hasher.add_value("bind", *input.bind);
    if (input.recipe) hasher.add("recipe", recipe_digest(*input.recipe));
  }
  hasher.add_value("operations", recipe.operations);
  hasher.add_value("surface", recipe.surface);
  hasher.add_value("animation", recipe.animation);
  if (recipe.correctives.method != RecipeDeform::None) hasher.add_value("correctives", recipe.correctives);
  hasher.add_value("output", recipe.output);
  return hasher.finish();
}

}  // namespace skinforge
