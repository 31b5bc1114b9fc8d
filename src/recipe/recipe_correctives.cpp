#include <fmt/core.h>

#include "recipe/recipe_parts.h"
#include "recipe/recipe_values.h"

namespace skinforge {

namespace {
void read_context(const ValueReader& reader, const ObjectReader& object, const Recipe& recipe,
                  CorrectivesOptions& options) {
  for (const ValueReader& item : object.at("examples").items()) {
    const ObjectReader example = item.object({"shape", "pose"});
    options.examples.push_back({read_path(example.at("shape")), read_path(example.at("pose"))});
  }
  if (options.examples.empty()) object.at("examples").fail("expected at least one example");
  if (const auto rest = object.find("rest")) options.rest = rest->boolean();
  if (const auto kernel = object.find("kernel"))
    options.kernel = kernel->choice<RecipeKernel>(
        {{"linear", RecipeKernel::Linear}, {"gaussian", RecipeKernel::Gaussian}});
  if (const auto joints = object.find("joints")) options.joints = read_joints(*joints);
  const bool is_bound = recipe.inputs[recipe.input_index(recipe.base)].bind.has_value();
  if (!is_bound || !recipe.operations.empty())
    reader.fail(
        "examples follow the vertices of the base, which must have \"bind\", and no \"ops\" may change "
        "them");
}
}  // namespace

CorrectivesOptions read_correctives(const ValueReader& reader, const Recipe& recipe) {
  const ObjectReader object =
      reader.object({"method", "targets", "enough", "examples", "rest", "kernel", "joints"});
  CorrectivesOptions options;
  options.method = object.at("method").choice<RecipeDeform>({{"dqs", RecipeDeform::DualQuaternion},
                                                             {"poisson", RecipeDeform::Poisson},
                                                             {"context", RecipeDeform::Context}});
  if (const auto targets = object.find("targets")) options.targets = targets->integer(1, 64);
  if (const auto enough = object.find("enough")) options.enough = enough->number(0, 1);
  if (options.method == RecipeDeform::Context) {
    read_context(reader, object, recipe, options);
    return options;
  }
  for (const char* key : {"examples", "rest", "kernel", "joints"})
    if (const auto value = object.find(key)) value->fail(fmt::format("{} is for method \"context\"", key));
  return options;
}

}  // namespace skinforge
