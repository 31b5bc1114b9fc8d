#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace skinforge {

/// What the header of an encoded image says.
struct ImageHeader {
  std::string mime;  ///< "image/png" or "image/jpeg"
  int width = 0;
  int height = 0;
};

/// Looks through a PNG (all chunks and their checksums) or JPEG (all segments up to the frame) without
/// decoding pixels. Throws Error (BadInput), one sentence, when it is neither, is damaged or cut short, or is
/// larger than 16384 pixels a side or 268 million pixels.
ImageHeader inspect_image(std::span<const std::byte> bytes);

}  // namespace skinforge
