#pragma once

#include <span>

#include "diff/character_diff.h"

namespace skinforge {

/// Whether both are drawn from the same data to the last bit, so that no picture of them can differ: mesh,
/// weights, skeleton, clips, materials, images and morph targets. O(bytes).
bool draw_alike(const Character& a, const Character& b);

/// A character and its images, decoded, by ImageId; those that are missing or empty count as white.
struct DrawnCharacter {
  const Character& character;
  std::span<const Raster> images;
};

/// Draws both by the same cameras, which hold all of A: the bind pose from the front, the side, three
/// quarters and behind; of the clips that both have the one that differs most, at its worst moment, from the
/// first three; the next two, at theirs, from three quarters. A clip without an error is seen in its middle.
/// `diff`: what `compare_characters` found. `keeps_pictures`: keep the drawings. Two characters
/// without faces are not drawn. The same bytes for any number of threads.
std::vector<PictureDiff> compare_pictures(const DrawnCharacter& a, const DrawnCharacter& b,
                                          const CharacterDiff& diff, bool keeps_pictures = false);

}  // namespace skinforge
