#include "stages/compared_pictures.h"

#include "base/archive.h"
#include "diff/picture_diff.h"
#include "stages/decoded_images.h"

namespace skinforge {

void add_pictures(const Character& a, const Character& b, CharacterDiff& diff,
                  const PictureOptions& options) {
  diff.is_drawn_alike = !options.draws_always && draw_alike(a, b);
  if (diff.is_drawn_alike) return;
  constexpr int kTexels = 1024;  // ours: along an image; pictures of 256 pixels show no finer ones
  IssueSink known;               // what is odd about an image is not what this compares
  const std::vector<Raster> of_a = decoded_images(a, "A", known, kTexels);
  const bool are_same =  // and of the same use: only what materials show is decoded
      to_bytes(a.images) == to_bytes(b.images) && to_bytes(a.materials) == to_bytes(b.materials);
  const std::vector<Raster> of_b = are_same ? std::vector<Raster>() : decoded_images(b, "B", known, kTexels);
  diff.pictures = compare_pictures({a, of_a}, {b, are_same ? of_a : of_b}, diff, options.keeps_drawings);
}

}  // namespace skinforge
