#pragma once

#include <string>

#include "model/material.h"

namespace skinforge {

/// How two drawings of one size differ. Counted are the pixels that a character covers in either of them, so
/// that an empty backdrop makes no difference small. Without such pixels nothing differs.
struct PictureDifference {
  /// Share of these pixels whose colour the other drawing does not have there, nor between its neighbours: an
  /// outline that moves by a part of a pixel changes none, another colour all.
  double changed = 0;
  double mean_error = 0;  ///< mean difference of red, green and blue as stored (sRGB), in [0, 1]
  /// Mean structural similarity, at most 1 (Wang, Bovik, Sheikh, Simoncelli 2004, "Image quality assessment",
  /// Sec. III-B: luma, Gaussian window of 11 x 11 with sigma 1.5, K1 = 0.01, K2 = 0.03).
  double ssim = 1;
  double overlap = 1;  ///< of the silhouettes: what both cover, of what either covers
};

/// Both with alpha as coverage (`DrawOptions::alpha_is_coverage`) and of one size. Symmetric. O(pixels).
PictureDifference picture_difference(const Raster& a, const Raster& b);

/// A, B, and A in grey with what differs in heat colours, side by side and opaque; `title` stands in A's
/// corner.
Raster picture_of_difference(const Raster& a, const Raster& b, const std::string& title);

}  // namespace skinforge
