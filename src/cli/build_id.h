#pragma once

#include <string>

namespace skinforge {

/// Version of the program and digest of what makes its results: the linker's build ids of the program and of
/// every library it runs with (OpenVDB's, too, which is loaded late), and which of its instruction sets the
/// mathematical library takes on this machine, e.g. "0.1.0+4f2a...". Part of every cache key, so results of
/// another program, another library or another arithmetic are never taken. An object that was linked without
/// a build id counts by its name alone.
std::string build_id();

}  // namespace skinforge
