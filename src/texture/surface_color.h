#pragma once

#include <span>

#include "model/material.h"
#include "model/polygon_mesh.h"

namespace skinforge {

/// One sRGB channel as stored in 8 bits -> linear light in [0, 1] (IEC 61966-2-1).
double linear_from_srgb8(std::uint8_t value);
/// Linear light -> 8 bits, rounded; values outside [0, 1] are clamped.
std::uint8_t srgb8_from_linear(double value);

enum class Transfer { Srgb, Linear };

/// RGBA of a texture at `uv` as an engine sees it at full resolution: KHR_texture_transform, wrap modes, then
/// nearest or bilinear filtering in linear light. `transfer` says how the file stores RGB (base colour and
/// emission: sRGB). White for an empty raster. Coordinates that are not finite count as 0.
Vec4 sample(const TextureRef& texture, const Raster& raster, const Vec2& uv, Transfer transfer);

/// A mesh with what its colours depend on.
struct ColoredMesh {
  const PolygonMesh* mesh = nullptr;
  std::span<const Material> materials;
  std::span<const Raster>
      images;  ///< by ImageId; an image that was not decoded is an empty raster and counts as white
};

/// Weights over three corners (indices into `PolygonMesh::corners`) of one face: a point of a triangle or of
/// an edge.
struct CornerMix {
  std::array<std::int32_t, 3> corners = {0, 0, 0};
  Vec3 weights = Vec3::Zero();  ///< sum 1
};

/// What a surface looks like at one point; linear.
struct SurfaceLook {
  Vec3 base_color = Vec3::Ones();
  Vec3 emissive = Vec3::Zero();
  double metallic = 1;
  double roughness = 1;
};

/// Material of a face; the glTF default material where it has none.
const Material& material_of(const ColoredMesh& colored, FaceId face);

/// Base colour (factor * texture * vertex colour), linear RGB.
Vec3 base_color_at(const ColoredMesh& colored, FaceId face, const CornerMix& at);

/// All of it: factors times textures.
SurfaceLook look_at(const ColoredMesh& colored, FaceId face, const CornerMix& at);

}  // namespace skinforge
