#pragma once

#include "diff/character_diff.h"
#include "diff/correspondence.h"

namespace skinforge {

/// How many of everything a character has. `bytes` is passed through.
CharacterCounts count(const Character& character, std::uint64_t bytes);

/// Keys of all tracks of a clip.
std::size_t key_count(const Clip& clip);

/// Counts of both sides (of the files: none), and what one has and the other has not.
StructureDiff compare_structure(const Character& a, const Character& b, const Correspondence& same);

}  // namespace skinforge
