#pragma once

#include <string>

#include "base/issue.h"
#include "model/character.h"

namespace skinforge {

/// `wanted`, or with "_2", "_3", ... behind it where the character has a clip of that name.
std::string free_clip_name(const Character& character, const std::string& wanted);

/// Adds the clips of `other` to `character`, joints matched by name. Tracks of joints that `character` does
/// not have are left out and counted in an issue; a clip name that is taken gets "_2", "_3", ... `place` is
/// the clip file's name.
void merge_clips(Character& character, const Character& other, const std::string& place, IssueSink& issues);

}  // namespace skinforge
