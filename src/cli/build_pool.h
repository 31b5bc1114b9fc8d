#pragma once

#include <vector>

#include "cli/build_recipe.h"

namespace skinforge {

/// Builds recipes side by side, as one pool (`share`): at most --jobs stages at a time whatever recipe they
/// are of, and a stage that several need runs once. What each says comes whole and in the order of the tasks.
/// Without
/// --keep-going nothing is begun after a failure. The outcomes of what was begun, in the order of the tasks.
std::vector<Outcome> build_all(const CommandLine& line, const std::vector<RecipeTask>& tasks,
                               WorkShare& share, Console& console, EventStream& events);

}  // namespace skinforge
