#pragma once

#include <vector>

#include "base/issue.h"
#include "io/export.h"
#include "model/character.h"

namespace skinforge {

/// The images of a character that its materials show as base colour or emission, decoded, by ImageId; the
/// others are empty rasters. One that cannot be decoded is a warning and counts as white. `max_width`: wider
/// ones are shrunk to it, one after another, pixels; 0: none is.
std::vector<Raster> decoded_images(const Character& character, const std::string& place, IssueSink& issues,
                                   int max_width = 0);

}  // namespace skinforge
