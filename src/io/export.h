#pragma once

#include <string>

#include "base/archive.h"
#include "base/hash.h"
#include "model/character.h"

namespace skinforge {

struct GlbOptions {
  std::size_t max_influences = 4;  ///< 4 or 8 (JOINTS_1/WEIGHTS_1)
  bool encode_polygons = true;     ///< FB_ngon_encoding: triangles of one polygon share their first vertex
  std::string extras_json;         ///< value of asset.extras.skinforge, JSON text; empty = none
};

/// The character as a GLB: core glTF 2.0, one skin, one root joint, skinned mesh at the scene root, default
/// pose = bind pose, `max_influences` sorted by weight and summing to 1 after rounding to float, keys bit for
/// bit, images as they were. 0 errors and 0 warnings from the Khronos validator. Equal characters give equal
/// bytes.
Bytes write_glb(const Character& character, const GlbOptions& options = {});

/// Polygons, UVs (set 0), normals, vertex colours, one `usemtl` per material run; positions with 9
/// significant digits.
std::string write_obj(const Character& character);

/// Positions and polygons of a shape of the mesh (#V), as binary little-endian PLY of floats.
Bytes write_ply(const PolygonMesh& mesh, std::span<const Vec3> positions);

/// PNG of a raster (deterministic; alpha kept only when some pixel is not opaque).
Bytes encode_png(const Raster& raster);

/// Pixels of a PNG or JPEG. Throws Error (BadInput); refuses more than 268 million pixels before decoding.
Raster decode_image(const Image& image);

}  // namespace skinforge
