#pragma once

#include <functional>
#include <vector>

#include "recipe/recipe.h"
#include "recipe/value_reader.h"

/// The members of a recipe, each read in a file of its own (recipe_<member>.cpp). What is not written keeps
/// its default. Every mismatch throws Error (Usage) with its place.
namespace skinforge {

/// Reads a recipe that is an input of this one; the value is what names it.
using ReadIncluded = std::function<Recipe(const ValueReader&, const std::filesystem::path&)>;

/// By rising name.
std::vector<RecipeInput> read_inputs(const ValueReader& reader, const ReadIncluded& included);

/// `recipe` has its inputs, base and surface, which the operations refer to.
std::vector<RecipeOperation> read_operations(const ValueReader& reader, const Recipe& recipe);

/// Changes what is written; the rest stays, since an operation starts from the recipe's.
void read_surface(const ValueReader& reader, SurfaceOptions& options);

AnimationOptions read_animation(const ValueReader& reader);

/// `recipe` has its inputs, base and operations.
CorrectivesOptions read_correctives(const ValueReader& reader, const Recipe& recipe);

OutputOptions read_output(const ValueReader& reader);

/// Budgets and the golden.
void read_expectations(const ValueReader& reader, Recipe& recipe);

}  // namespace skinforge
