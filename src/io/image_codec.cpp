#include "io/image_codec.h"

#include <fmt/format.h>

#include <array>
#include <climits>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string_view>

#include "base/error.h"
#include "base/expect.h"
#include "base/limits.h"
#include "base/text.h"
#include "io/export.h"
#include "io/png_chunks.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wunused-but-set-variable"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#ifndef __clang__  // it does not know this one
#pragma GCC diagnostic ignored "-Wduplicated-branches"
#endif
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_NO_STDIO
#define STBI_NO_HDR
#define STBI_NO_LINEAR
#include <stb/stb_image.h>
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

namespace skinforge {
namespace {

using ByteSpan = std::span<const std::byte>;

[[noreturn]] void bad(const std::string& sentence) {
  throw Error(ExitCode::BadInput, sentence);
}

std::uint32_t big_endian(ByteSpan bytes, std::size_t offset, std::size_t size) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < size; ++i)
    value = value << 8 | std::to_integer<std::uint32_t>(bytes[offset + i]);
  return value;
}

ImageHeader checked(std::string mime, std::uint32_t width, std::uint32_t height) {
  if (width == 0 || height == 0) bad("image without pixels");
  if (width > limits().image_side || height > limits().image_side)
    bad(fmt::format("image of {} x {} pixels, {}", width, height, limit_hint("image-side")));
  if (std::uint64_t{width} * height > limits().pixels)
    bad(fmt::format("image of {} x {} pixels, {}", width, height, limit_hint("pixels")));
  return {std::move(mime), static_cast<int>(width), static_cast<int>(height)};
}

constexpr std::string_view kPngSignature = "\x89PNG\r\n\x1A\n";

ImageHeader inspect_png(ByteSpan bytes) {
  constexpr std::size_t kFrame = 12;  // length, type and checksum of a chunk
  ImageHeader header;
  for (std::size_t at = kPngSignature.size(); at + kFrame <= bytes.size();) {
    const std::size_t length = big_endian(bytes, at, 4);
    if (length > bytes.size() - at - kFrame) break;
    const std::string_view type(reinterpret_cast<const char*>(bytes.data()) + at + 4, 4);
    if (png_checksum(bytes.subspan(at + 4, length + 4)) != big_endian(bytes, at + 8 + length, 4))
      bad("damaged PNG: a checksum is wrong");
    if (header.mime.empty()) {
      if (type != "IHDR" || length != 13) bad("damaged PNG: it does not start with its header");
      header = checked("image/png", big_endian(bytes, at + 8, 4), big_endian(bytes, at + 12, 4));
    }
    if (type == "IEND") return header;
    at += kFrame + length;
  }
  bad("truncated PNG");
}

/// Whether a JPEG marker opens a frame (SOF0 to SOF15 without DHT, JPG and DAC).
bool opens_frame(std::uint32_t marker) {
  return marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
}

ImageHeader inspect_jpeg(ByteSpan bytes) {
  for (std::size_t at = 2; at + 4 <= bytes.size();) {
    if (bytes[at] != std::byte{0xFF}) bad("damaged JPEG: a marker is missing");
    const std::uint32_t marker = big_endian(bytes, at + 1, 1);
    if (marker == 0xFF) {  // fill byte
      ++at;
      continue;
    }
    const std::size_t length = big_endian(bytes, at + 2, 2);
    if (length < 2 || length > bytes.size() - at - 2) break;
    if (opens_frame(marker)) {
      if (length < 7) bad("damaged JPEG: its frame header is too short");
      return checked("image/jpeg", big_endian(bytes, at + 7, 2), big_endian(bytes, at + 5, 2));
    }
    if (marker == 0xDA || marker == 0xD9) bad("damaged JPEG: no frame before the pixels");
    at += 2 + length;
  }
  bad("truncated JPEG");
}

void append_bytes(void* context, void* data, int size) {
  auto& bytes = *static_cast<Bytes*>(context);
  const auto* begin = static_cast<const std::byte*>(data);
  bytes.insert(bytes.end(), begin, begin + size);
}

}  // namespace

ImageHeader inspect_image(ByteSpan bytes) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (text.starts_with(kPngSignature)) return inspect_png(bytes);
  if (text.starts_with("\xFF\xD8\xFF")) return inspect_jpeg(bytes);
  bad("image is neither PNG nor JPEG");
}

Bytes encode_jpeg(const Raster& raster, int quality) {
  SF_EXPECT(raster.width > 0 && raster.height > 0 && quality >= 1 && quality <= 100);
  SF_EXPECT(raster.rgba.size() == std::size_t{4} * raster.width * raster.height);
  Bytes bytes;
  const int done = stbi_write_jpg_to_func(append_bytes, &bytes, raster.width, raster.height, 4,
                                          raster.rgba.data(), quality);
  SF_EXPECT(done != 0);
  return bytes;
}

Raster decode_image(const Image& image) {
  const ImageHeader header = inspect_image(image.bytes);
  if (image.bytes.size() > INT_MAX) bad("image of more than 2 GB");
  constexpr std::uint64_t kPerPixel = 12;  // filtered rows, decoded pixels and ours, four bytes each
  const std::uint64_t needed = kPerPixel * static_cast<std::uint64_t>(header.width) * header.height;
  if (needed > limits().memory)
    bad(fmt::format("decoding {} x {} pixels takes {} bytes, {}", header.width, header.height, needed,
                    limit_hint("memory")));
  Raster raster;
  int channels = 0;
  const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> pixels(
      stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(image.bytes.data()),
                            static_cast<int>(image.bytes.size()), &raster.width, &raster.height, &channels,
                            4),
      &stbi_image_free);
  if (!pixels) bad(fmt::format("damaged {}: {}", header.mime, printable(stbi_failure_reason())));
  raster.rgba.assign(pixels.get(), pixels.get() + std::size_t{4} * raster.width * raster.height);
  return raster;
}

}  // namespace skinforge
