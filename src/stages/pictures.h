#pragma once

#include <span>
#include <string>
#include <vector>

#include "stages/stages.h"

namespace skinforge {

/// Names of all pictures of a build, without ending: "rest", "weights", "junction1" ..., "clip_<name>" ...;
/// safe as file names.
std::vector<std::string> picture_names(const Recipe& recipe, std::span<const ClipRequest> clips);

/// "clip_<name>" as a safe file name; names that would fall together get a number by their order.
std::vector<std::string> clip_picture_names(std::span<const ClipRequest> clips);

}  // namespace skinforge
