#pragma once

#include "fuzz/input.h"
#include "io/export.h"
#include "io/image_codec.h"
#include "io/png_chunks.h"

namespace skinforge::fuzz {

/// The bytes with every PNG checksum as it must be: no mutation finds one, and without it nothing behind it
/// is read.
inline Bytes with_checksums(Bytes bytes) {
  constexpr std::size_t kFrame = 12;  // length, type and checksum of a chunk
  for (std::size_t at = kPngSignatureSize; at + kFrame <= bytes.size();) {
    std::size_t length = 0;
    for (std::size_t i = 0; i < 4; ++i) length = length << 8 | std::to_integer<std::size_t>(bytes[at + i]);
    if (length > bytes.size() - at - kFrame) break;
    const std::uint32_t sum = png_checksum(std::span(bytes).subspan(at + 4, length + 4));
    for (std::size_t i = 0; i < 4; ++i)
      bytes[at + 8 + length + i] = static_cast<std::byte>(sum >> (24 - 8 * i));
    at += kFrame + length;
  }
  return bytes;
}

/// As it is, and with its checksums mended; what could be decoded is packed as JPEG and decoded again.
inline void feed_image(std::span<const std::byte> bytes) {
  const Bytes mended = with_checksums(Bytes(bytes.begin(), bytes.end()));
  const Raster raster = decode_image({"a", "image/png", mended});
  if (raster.width <= 64 && raster.height <= 64) decode_image({"b", "image/jpeg", encode_jpeg(raster, 80)});
  decode_image({"a", "image/png", Bytes(bytes.begin(), bytes.end())});
}

}  // namespace skinforge::fuzz
