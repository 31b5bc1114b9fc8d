#pragma once

#include <span>

#include "diff/character_diff.h"
#include "io/import.h"

namespace skinforge {

/// What the files of one side of a comparison say beside their character: size of the first, what it was made
/// of, rules of glTF that it breaks. `files` as from `read_input_files`, of a model that can be read.
FileFacts facts_of(const std::vector<InputFile>& files);

}  // namespace skinforge
