#include "io/png_chunks.h"

#include <array>

namespace skinforge {

/// PNG specification, annex D.
std::uint32_t png_checksum(std::span<const std::byte> bytes) {
  static const auto kTable = [] {
    std::array<std::uint32_t, 256> table{};
    for (std::uint32_t n = 0; n < 256; ++n) {
      std::uint32_t c = n;
      for (int bit = 0; bit < 8; ++bit) c = (c & 1) != 0 ? 0xEDB88320u ^ (c >> 1) : c >> 1;
      table[n] = c;
    }
    return table;
  }();
  std::uint32_t crc = 0xFFFFFFFFu;
  for (const std::byte b : bytes) crc = kTable[(crc ^ std::to_integer<std::uint32_t>(b)) & 0xFF] ^ (crc >> 8);
  return crc ^ 0xFFFFFFFFu;
}

std::vector<PngChunk> png_chunks(std::span<const std::byte> png) {
  std::vector<PngChunk> chunks;
  for (std::size_t at = kPngSignatureSize; at + 12 <= png.size();) {
    std::size_t length = 0;
    for (std::size_t i = 0; i < 4; ++i) length = length << 8 | std::to_integer<std::size_t>(png[at + i]);
    chunks.push_back(
        {std::string(reinterpret_cast<const char*>(png.data()) + at + 4, 4), png.subspan(at + 8, length)});
    at += 12 + length;
  }
  return chunks;
}

}  // namespace skinforge
