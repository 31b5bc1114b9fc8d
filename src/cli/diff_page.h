#pragma once

#include <string>
#include <vector>

#include "cli/command_line.h"
#include "diff/character_diff.h"

namespace skinforge {

/// Both models side by side in one file, under one camera and one clock, coloured by how far each vertex
/// moves otherwise, with all findings.
std::string diff_page(const DiffRequest& request, const Character& a, const Character& b,
                      const CharacterDiff& diff, const std::vector<DiffFinding>& findings);

}  // namespace skinforge
