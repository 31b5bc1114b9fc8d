#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace skinforge {

/// RFC 4648, with padding, in one line.
std::string base64(std::span<const std::byte> bytes);

}  // namespace skinforge
