#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/stage.h"

namespace skinforge {

/// A property of a recipe and the stages that take it into their own keys. Stages behind those run again only
/// when what they read has other bytes.
struct StageSetting {
  std::string_view property;             ///< JSON pointer, * for a name or index; all below it, too
  std::vector<std::string_view> stages;  ///< by name; the longest property that fits a setting counts
  bool is_path = false;                  ///< where a file lies: no part of what the recipe asks for
};

/// The table: every property of the schema is in it, or below one that is. Besides what stands in it, every
/// setting but paths and "/expect" enters `export`, `report` and `preview`, which write the digest of the
/// recipe.
std::span<const StageSetting> stage_settings();

/// Whether the stage takes the setting (a JSON pointer as recipe_settings gives them) into its key. Stages of
/// one input or operation take those of that one only, stages of a recipe inside the recipe those behind
/// "/inputs/<name>/recipe".
bool reads_setting(const StageInfo& stage, std::string_view setting);

/// The setting that names a source file, from the artifact that holds it: "file:horse:0" gives
/// "/inputs/horse". None for an artifact that a stage makes.
std::optional<std::string> setting_of_source(std::string_view artifact);

}  // namespace skinforge
