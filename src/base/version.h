#pragma once

namespace skinforge {

/// Version of the tool, as `skinforge version` prints it and as outputs carry it.
inline constexpr const char* kVersion = "0.1.0";

}  // namespace skinforge
