#pragma once

#include "diff/character_diff.h"
#include "diff/correspondence.h"

namespace skinforge {

/// How many of everything a character has; of its file nothing.
CharacterCounts count(const Character& character);

/// Keys of all tracks of a clip.
std::size_t key_count(const Clip& clip);

/// Counts of both sides, and what one has and the other has not.
StructureDiff compare_structure(const Character& a, const Character& b, const Correspondence& same);

}  // namespace skinforge
