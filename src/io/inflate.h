#pragma once

#include <cstddef>
#include <span>

namespace skinforge {

/// Unpacks zlib data into `target`; false when it is damaged or does not fill `target` exactly.
bool inflate_exactly(std::span<const std::byte> packed, std::span<std::byte> target);

}  // namespace skinforge
