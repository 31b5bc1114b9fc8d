#pragma once

#include <vector>

#include "base/issue.h"
#include "io/import.h"

namespace skinforge {

/// Warns of what Assimp passes over in an OBJ: faces without corners, materials that no library of the file
/// defines, lines so long that the file is hardly meant. `files`: the OBJ, then what it names. Throws
/// nothing.
void check_obj(const std::vector<InputFile>& files, std::vector<Issue>& issues);

}  // namespace skinforge
