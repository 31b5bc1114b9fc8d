#pragma once

#include "recipe/recipe.h"
#include "stages/stages.h"

namespace skinforge {

/// result, glb -> expectations: the budgets of "expect". Whatever is not kept fails the stage with exit 4 and
/// one line that names all of it; nothing depends on it, so the files are written all the same.
StagePointer make_expect_stage(const ArtifactNames& names, const Recipe& recipe);

/// Name of that stage.
constexpr const char* kExpectStage = "expect";

}  // namespace skinforge
