#pragma once

#include <vector>

#include "model/character.h"
#include "render/pictures.h"

namespace skinforge {

/// The character at some times of a clip as an engine plays it, morph targets first and linear blending
/// after, for pictures.
std::vector<ClipFrame> frames_at(const Character& character, const Clip& clip,
                                 const std::vector<double>& times);

}  // namespace skinforge
