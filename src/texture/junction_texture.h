#pragma once

#include <span>
#include <vector>

#include "geometry/triangle_bvh.h"
#include "texture/charts.h"
#include "texture/surface_color.h"

namespace skinforge {

/// One placed source whose colours reach into the junction.
struct TextureSource {
  ColoredMesh colored;                       ///< the input's mesh, materials and decoded images
  std::span<const Vec3> positions;           ///< #V of the input, placed
  const Triangulation* triangles = nullptr;  ///< of the input's mesh
  const TriangleBvh* bvh = nullptr;          ///< over `positions` and `triangles`
  std::span<const double> factor;  ///< #V of the result: its share at each vertex, 1 or 0 at borders (Sec. 7)
};

/// The new faces whose colours are wanted.
struct JunctionSurface {
  const PolygonMesh* mesh = nullptr;  ///< the result; positions and normals are read
  std::span<const FaceId> faces;      ///< of all junctions, they share one texture
};

struct JunctionTextureOptions {
  ChartOptions charts;
  int smallest = 64;  ///< texels a side, powers of two
  int largest = 1024;
  int gutter = 2;  ///< texels around each chart that repeat its rim
  double texels_per_edge =
      6;  ///< at least so many along a mean edge of the junction, where neighbours have no texture
};

/// Colour of the junction, ready for one material.
struct JunctionTexture {
  std::vector<Vec2>
      uv;  ///< one per corner of `faces`, face after face, in [0, 1], v down; empty without a texture
  Raster base_color;  ///< sRGB, opaque; empty (width 0) when the junction has one colour, which `material`
                      ///< then has
  Material material;  ///< named "junction"; its base colour texture, if any, has no image id yet
  std::size_t charts = 0;
  double texels_per_metre = 0;  ///< of `base_color`
  double neighbours_density =
      0;  ///< texels per metre of the sources' textures beside the junction (median); 0 = no texture
};

/// Bakes the sources' colours onto the junction (the paper leaves that to future work, Sec. 7.2, and blurs
/// vertex colours).
/// 1. Charts (`make_charts`: rings unrolled, the rest projected), packed at the density of the neighbours'
/// textures.
/// 2. For every texel the point on the junction, its shares between the sources (interpolated over the
/// triangle, then flat
///    near 0 and 1, so that colours are exactly the neighbours' in the first texels beside a border), the
///    closest point on each source that has a share, and the colour there as an engine would show it.
/// 3. Mixed in linear light, stored as sRGB; unused texels filled from around them.
/// A closest point that faces away is replaced by what a ray along the normal meets, if that faces the right
/// way. Metallic, roughness and emission become factors: means over the area of the junction. Double-sided if
/// any material involved is, unlit if all are; opaque. Normal and occlusion maps are not baked. A texture and
/// not vertex colours: a hard edge between two colours stays sharp inside a triangle, and every engine shows
/// base colour textures, while vertex colours need a material made for them in some. A junction of one colour
/// (within half an 8-bit step) gets no texture at all. Empty `faces` give an empty result. Parallel over
/// texel rows; same bits for any number of threads.
JunctionTexture bake_junction_texture(const JunctionSurface& junction, std::span<const TextureSource> sources,
                                      const JunctionTextureOptions& options = {});

}  // namespace skinforge
