#include <algorithm>

#include "base/expect.h"
#include "io/export.h"
#include "io/png_chunks.h"

namespace skinforge {
namespace {

void append(Bytes& bytes, std::span<const std::byte> more) {
  bytes.insert(bytes.end(), more.begin(), more.end());
}

void append_number(Bytes& bytes, std::uint32_t number, int size) {
  for (int shift = 8 * (size - 1); shift >= 0; shift -= 8)
    bytes.push_back(static_cast<std::byte>(number >> shift & 0xFF));
}

void append_chunk(Bytes& png, const char* kind, std::span<const std::byte> data) {
  append_number(png, static_cast<std::uint32_t>(data.size()), 4);
  const std::size_t begin = png.size();
  for (int i = 0; i < 4; ++i) png.push_back(static_cast<std::byte>(kind[i]));
  append(png, data);
  append_number(png, png_checksum(std::span(png).subspan(begin)), 4);
}

// Frame control: whole pictures, each in place of the one before.
Bytes frame_control(std::uint32_t sequence, const Raster& frame, double seconds) {
  Bytes data;
  append_number(data, sequence, 4);
  append_number(data, static_cast<std::uint32_t>(frame.width), 4);
  append_number(data, static_cast<std::uint32_t>(frame.height), 4);
  append_number(data, 0, 4);  // x
  append_number(data, 0, 4);  // y
  append_number(data, static_cast<std::uint32_t>(std::clamp(seconds * 1000 + 0.5, 1.0, 65535.0)), 2);
  append_number(data, 1000, 2);
  append_number(data, 0, 2);  // keep, then overwrite
  return data;
}

}  // namespace

Bytes encode_animated_png(std::span<const Raster> frames, double seconds_per_frame) {
  SF_EXPECT(!frames.empty());
  Bytes animated;
  std::uint32_t sequence = 0;
  for (std::size_t f = 0; f < frames.size(); ++f) {
    SF_EXPECT(frames[f].width == frames[0].width && frames[f].height == frames[0].height);
    const Bytes png = encode_png(frames[f]);
    Bytes pixels;  // of all its data chunks
    for (const PngChunk& chunk : png_chunks(png)) {
      if (f == 0 && chunk.kind == "IHDR") {
        append(animated, std::span(png).first(kPngSignatureSize));
        append_chunk(animated, "IHDR", chunk.data);
        Bytes control;
        append_number(control, static_cast<std::uint32_t>(frames.size()), 4);
        append_number(control, 0, 4);  // for ever
        append_chunk(animated, "acTL", control);
      }
      if (chunk.kind == "IDAT") append(pixels, chunk.data);
    }
    append_chunk(animated, "fcTL", frame_control(sequence++, frames[f], seconds_per_frame));
    Bytes data;
    if (f > 0) append_number(data, sequence++, 4);
    append(data, pixels);
    append_chunk(animated, f == 0 ? "IDAT" : "fdAT", data);
  }
  append_chunk(animated, "IEND", {});
  return animated;
}

}  // namespace skinforge
