#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "diff/character_diff.h"

namespace skinforge {

/// For people: counts side by side, the edits, the findings ("!" in front of those over their threshold), a
/// table of clips. Ends with a line break.
std::string to_text(const CharacterDiff& diff, const std::vector<DiffFinding>& findings);

/// The same for programs, with every number.
nlohmann::json to_json(const CharacterDiff& diff, const std::vector<DiffFinding>& findings);

}  // namespace skinforge
