#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace skinforge {

/// 8-bit red, green and blue, as stored in images.
using Color8 = std::array<std::uint8_t, 3>;

/// A colour written as "#ff8000"; none for any other text.
std::optional<Color8> parse_color(std::string_view text);

}  // namespace skinforge
