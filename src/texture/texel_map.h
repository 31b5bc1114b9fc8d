#pragma once

#include <array>
#include <span>
#include <vector>

#include "base/math.h"
#include "model/material.h"

namespace skinforge {

/// What a texel shows: a point of one triangle.
struct TexelPoint {
  std::int32_t triangle = -1;  ///< -1: nothing near
  Vec3 barycentric = Vec3::Zero();
};

/// For each texel of a `width` x `height` image, row by row from the top, the point of the nearest triangle
/// within `reach` texels of its centre (texel (x, y) has its centre at (x + 0.5, y + 0.5)): the inside of a
/// triangle is itself, a gutter texel shows the nearest point of the chart's rim, so that filtering across
/// the rim reads the rim's own colour. Ties go to the lowest triangle. Degenerate triangles are segments or
/// points.
std::vector<TexelPoint> map_texels(std::span<const std::array<Vec2, 3>> triangles, int width, int height,
                                   double reach);

/// Gives every texel that `is_set` says nothing about (RGBA untouched) the colour of its surroundings, by
/// averaging the set texels up a pyramid and filling back down, so that smaller mip levels do not drag in
/// foreign colours. Sides powers of two. With no texel set the image turns white.
void fill_unset(Raster& raster, std::vector<bool> is_set);

}  // namespace skinforge
