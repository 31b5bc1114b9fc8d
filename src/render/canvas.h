#pragma once

#include <span>
#include <string_view>

#include "base/math.h"
#include "model/material.h"

namespace skinforge {

/// Pixels of one letter of the built-in font at scale 1, with the free column and row beside it.
inline constexpr int kLetterWidth = 6, kLetterHeight = 9;

/// An opaque picture of one colour (linear RGB).
Raster blank_picture(int width, int height, const Vec3& color);

/// Copies `picture` onto `canvas` with its top left pixel at (x, y); what falls outside is cut off.
void paste(Raster& canvas, const Raster& picture, int x, int y);

struct TileOptions {
  int columns = 0;                   ///< 0: all pictures in one row
  int gap = 4;                       ///< pixels between pictures and around them
  Vec3 color = Vec3(0.9, 0.9, 0.9);  ///< of the gaps, linear RGB
};

/// Pictures side by side, row after row, in cells as large as the largest; smaller ones stand in the middle.
/// No pictures: one pixel of the gap's colour.
Raster tile(std::span<const Raster> pictures, const TileOptions& options = {});

struct LabelOptions {
  int scale = 2;                         ///< size of a font pixel
  Vec3 color = Vec3(0.02, 0.025, 0.04);  ///< linear RGB
  double strength = 0.85;                ///< 1 = covers what is below
};

/// Writes `text` with the top left of its first letter at (x, y); letters outside the picture are cut.
/// Characters that are not printable ASCII appear as a box.
void label(Raster& picture, int x, int y, std::string_view text, const LabelOptions& options = {});

/// Width of `text` in pixels at `scale`.
int label_width(std::string_view text, int scale = 2);

}  // namespace skinforge
