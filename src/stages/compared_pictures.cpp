#include "stages/compared_pictures.h"

#include "diff/picture_diff.h"
#include "stages/decoded_images.h"

namespace skinforge {

void add_pictures(const Character& a, const Character& b, CharacterDiff& diff,
                  const PictureOptions& options) {
  diff.is_drawn_alike = !options.draws_always && draw_alike(a, b);
  if (diff.is_drawn_alike) return;
  IssueSink known;  // what is odd about an image is not what this compares
  const std::vector<Raster> images_a = decoded_images(a, "A", known),
                            images_b = decoded_images(b, "B", known);
  diff.pictures = compare_pictures({a, images_a}, {b, images_b}, diff, options.keeps_drawings);
}

}  // namespace skinforge
