#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "pipeline/engine.h"
#include "pipeline/publish.h"
#include "recipe/recipe.h"
#include "stages/stages.h"

namespace skinforge {

/// How much a build says about its result besides the character.
enum class ReportLevel : std::uint8_t { None, Json, Full };  ///< Full: with pictures

/// The stages of one recipe, in two batches because the clips are known only when the inputs are.
///   add_imports(recipe, engine, settle); settle(); add_grafts(recipe, engine, level); engine.run();
///   publish(engine, outputs(...), folder)
/// Recipes used as inputs bring their own stages.

/// Makes the results of what was added known as far as possible: `engine.run()` for a build, `engine.plan()`
/// where nothing may run.
using Settle = std::function<void()>;

/// Input files become sources of the engine (read once, hashed), and one import stage each is added; of a
/// recipe used as an input all stages, which takes its own inputs to be settled. False when those stay
/// unknown: that input has no stages behind its imports then. Throws Error (BadInput) for a missing file,
/// with the place in the recipe that names it.
bool add_imports(const Recipe& recipe, Engine& engine, const Settle& settle, const ArtifactNames& names = {});

/// Whether the contents of all inputs are known, so that `add_grafts` can be called.
bool knows_contents(const Recipe& recipe, const Engine& engine, const ArtifactNames& names = {});

/// Everything behind the imports, from what they found. Throws Error (Usage) for an unknown clip.
void add_grafts(const Recipe& recipe, Engine& engine, ReportLevel level, const ArtifactNames& names = {});

/// In the place of `add_grafts`: the stages of a preview.
void add_preview(const Recipe& recipe, Engine& engine, const ArtifactNames& names = {});

/// The files a preview writes, relative to the output folder; their names differ from those of a build.
std::vector<OutputFile> preview_outputs(const Recipe& recipe, ReportLevel level,
                                        const ArtifactNames& names = {});

/// The files a build writes, relative to the output folder.
std::vector<OutputFile> outputs(const Recipe& recipe, Engine& engine, ReportLevel level,
                                const ArtifactNames& names = {});

}  // namespace skinforge
