#pragma once

#include "model/polygon_mesh.h"

namespace skinforge {

/// How the first UV set lies on the surface. Parts without UVs count nowhere.
struct UvMeasures {
  /// L2 stretch of the whole (Sander, Snyder, Gortler, Hoppe 2001, "Texture mapping progressive meshes", Sec.
  /// 3): the root of the mean square, by area on the surface, of those of its triangles, scaled so that both
  /// areas are equal. 1: a texel is the same square everywhere; 0 without UVs. A mirrored triangle, infinite
  /// in the paper, counts as its mirror image: characters share textures of both halves.
  double stretch = 0;
  double stretch_max = 0;     ///< of a triangle
  std::size_t triangles = 0;  ///< that were measured
  /// With an area on the surface and below a texel in the texture (a palette of colours); in no other number.
  std::size_t flat = 0;
  /// Share of the texture's covered area that is covered more than once, in [0, 1], of each material by
  /// itself, the texture repeated. Counted at the centres of 256 x 256 pixels; a triangle over more than 16
  /// repetitions is left out.
  double overlap = 0;
};
UvMeasures measure_uvs(const PolygonMesh& mesh);

}  // namespace skinforge
