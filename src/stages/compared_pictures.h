#pragma once

#include "diff/character_diff.h"

namespace skinforge {

struct PictureOptions {
  bool keeps_drawings = false;  ///< leave them in the PictureDiffs
  bool draws_always = false;    ///< even where no picture could differ
};

/// Draws both characters and compares the pictures (diff/picture_diff.h), into `diff`; where no picture could
/// differ, says so instead. An image that cannot be decoded counts as white.
void add_pictures(const Character& a, const Character& b, CharacterDiff& diff,
                  const PictureOptions& options = {});

}  // namespace skinforge
