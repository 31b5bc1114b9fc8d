#pragma once

#include <span>

#include "texture/surface_color.h"

namespace skinforge {

/// How much colours jump where new faces meet old ones, in steps of 8 bits (sRGB, largest channel).
struct ColorSteps {
  std::size_t edges = 0;  ///< edges with a new and an old face
  double mean = 0;
  double p95 = 0;
  double largest = 0;
};

/// Compares both sides of every edge between a face of `new_faces` and any other face, at a quarter, half and
/// three quarters of its length (the mean of the three is the step of that edge), each side through its own
/// UVs, material and image: what an engine shows. A material border that the artist drew along that edge
/// counts too. (junction.md, e.6: mean <= 2, 95th percentile <= 8.) All 0 without such edges.
ColorSteps color_steps(const ColoredMesh& colored, std::span<const FaceId> new_faces);

}  // namespace skinforge
