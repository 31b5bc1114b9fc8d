#pragma once

#include <vector>

#include "model/character.h"
#include "render/pictures.h"

namespace skinforge {

/// The skin of a character at some times of a clip, for pictures.
std::vector<ClipFrame> frames_at(const Character& character, const Clip& clip,
                                 const std::vector<double>& times);

}  // namespace skinforge
