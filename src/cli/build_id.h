#pragma once

#include <string>

namespace skinforge {

/// Version and the linker's build id of this program, e.g. "0.1.0+4f2a...": part of every cache key, so
/// results of another program are never taken. The version alone when the program was linked without one.
std::string build_id();

}  // namespace skinforge
