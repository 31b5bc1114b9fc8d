#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/archive.h"

namespace skinforge {

inline constexpr std::size_t kPngSignatureSize = 8;

struct PngChunk {
  std::string kind;  ///< four letters
  std::span<const std::byte> data;
};

/// The chunks of a sound PNG (one that `encode_png` made, or `inspect_image` passed), in order; they refer to
/// its bytes.
std::vector<PngChunk> png_chunks(std::span<const std::byte> png);

/// CRC-32 of ISO 3309, as PNG chunks have it over kind and data.
std::uint32_t png_checksum(std::span<const std::byte> bytes);

}  // namespace skinforge
