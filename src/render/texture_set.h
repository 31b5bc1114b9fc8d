#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "model/material.h"

namespace skinforge {

/// Images ready for sampling: each with its chain of halved levels (averaged in linear light), so that a
/// texture shown small does not flicker. About 4/3 of the pixels are kept; immutable after construction.
class TextureSet {
 public:
  TextureSet() = default;
  /// `images` by ImageId; an image of no pixels (not decoded) samples as white.
  explicit TextureSet(std::span<const Raster> images);

  /// Linear RGBA in [0, 1] of `ref` at `uv` (v down, after the reference's own offset, rotation and scale).
  /// `spread`: how far uv moves over one pixel of the picture (0 = full detail). Wrap modes and point
  /// sampling as `ref` says. An image that is not in the set is white.
  Eigen::Vector4f sample(const TextureRef& ref, const Eigen::Vector2f& uv, float spread) const;

 private:
  std::vector<std::vector<Raster>> levels_;  ///< per image, largest first
};

}  // namespace skinforge
