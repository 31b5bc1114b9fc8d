#pragma once

#include "recipe/recipe.h"
#include "surface/assemble.h"
#include "surface/selection.h"
#include "surface/site_field.h"

/// What a recipe's "surface" means to the layer that makes surfaces.
namespace skinforge {

/// `is_donor`: of the side that the part comes from.
SelectionOptions selection_options(const SurfaceOptions& surface, bool is_donor);

FieldOptions field_options(const RecipeOperation& operation);

JunctionElements junction_elements(const SurfaceOptions& surface);

}  // namespace skinforge
