#pragma once

#include <string>

namespace skinforge {

/// Ending of a path in lower case, with its dot: ".glb". Empty when it has none.
std::string lower_extension(const std::string& path);

}  // namespace skinforge
