#pragma once

#include <array>
#include <cstdint>

namespace skinforge {

inline constexpr int kGlyphColumns = 5, kGlyphRows = 8;

/// Rows of a letter from the top, the leftmost pixel in bit 4; the last row is below the baseline.
using Glyph = std::array<std::uint8_t, kGlyphRows>;

/// The letter's glyph; a box for characters that are not printable ASCII.
const Glyph& glyph_of(char letter);

inline bool is_inked(const Glyph& glyph, int column, int row) {
  return (glyph[static_cast<std::size_t>(row)] >> (kGlyphColumns - 1 - column) & 1) != 0;
}

}  // namespace skinforge
