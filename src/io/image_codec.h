#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "base/archive.h"
#include "model/material.h"

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

/// JPEG of a raster, its alpha left out; `quality` in [1, 100]. Deterministic.
Bytes encode_jpeg(const Raster& raster, int quality);

}  // namespace skinforge
