#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/math.h"

namespace skinforge {

/// Vertices as they are written, and the polygons over them.
struct TangentInput {
  const std::vector<std::vector<std::uint32_t>>& polygons;
  const std::vector<float>& positions;   ///< 3 a vertex
  const std::vector<float>& normals;     ///< 3 a vertex, unit length
  const std::vector<float>& uvs;         ///< 2 a vertex, v down
  const std::vector<float>& handedness;  ///< +1 or -1 a vertex
};

/// +1 where the UVs of a polygon run the way its corners do as seen in a texture with v up, -1 where they are
/// mirrored.
float uv_handedness(std::span<const Vec2> uvs);

/// Tangent (x, y, z, handedness) per vertex: direction of growing u, mean of the directions of the corners
/// weighted by their angles (as MikkTSpace does), made orthogonal to the normal, unit length. Where the UVs
/// give no direction, any orthogonal one.
std::vector<float> vertex_tangents(const TangentInput& input);

}  // namespace skinforge
