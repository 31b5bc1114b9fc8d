#pragma once

#include "recipe/recipe.h"
#include "stages/stages.h"

namespace skinforge {

/// result, glb -> expectations: the budgets of "expect". Whatever is not kept fails the stage with exit 4 and
/// one line that names all of it; nothing depends on it, so the files are written all the same.
StagePointer make_expect_stage(const ArtifactNames& names, const Recipe& recipe);

/// glb, golden -> comparison: how the result differs from the golden of the recipe, as `diff` finds it. What
/// is over its threshold is a warning here; `make_golden_stage` makes it the verdict.
StagePointer make_compare_stage(const ArtifactNames& names, const GoldenOptions& golden);

/// comparison -> verdict: fails with exit 5 where the result differs, and with exit 3 where there is no
/// golden yet. Nothing depends on it either.
StagePointer make_golden_stage(const ArtifactNames& names, const GoldenOptions& golden);

/// Whether a stage only judges what is there: files are written even where it fails.
bool is_verdict(const StageInfo& stage);

/// Whether a stage only tells of the character (measures, pictures, comparisons), which is the same without
/// it.
bool is_of_report(const StageInfo& stage);

}  // namespace skinforge
