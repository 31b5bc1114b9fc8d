#pragma once

#include <span>
#include <vector>

#include "render/subject.h"
#include "render/visibility.h"

namespace skinforge {

/// A triangle of a subject that a view may show.
struct ViewedTriangle {
  ScreenTriangle screen;
  std::int32_t triangle = 0;  ///< of the subject
  float spread = 0;           ///< how far the base colour texture's uv moves over one pixel
  std::array<float, 3> wire = {0, 0,
                               0};  ///< strength in [0, 1] of the line along the side opposite each corner
};

struct ViewedOptions {
  bool back_faces = false;  ///< also those of single-sided materials
  bool wireframe = false;   ///< work out `wire`
};

/// The triangles inside the picture, in the order of the mesh. Back faces of single-sided materials,
/// degenerate triangles and those with a position that is not finite are left out. Lines of triangles only a
/// few pixels high are weakened, so that a fine mesh turns grey and not black.
std::vector<ViewedTriangle> viewed_triangles(const Subject& subject, std::span<const Vec3> positions,
                                             const Projection& projection, const ViewedOptions& options);

/// Indices into `triangles` of those that may touch each block of VisibilityTile::kEdge pixels, row after row
/// of `tiles_across` blocks, rising.
std::vector<std::vector<std::int32_t>> triangles_by_tile(std::span<const ViewedTriangle> triangles,
                                                         int tiles_across, int tiles_down);

}  // namespace skinforge
