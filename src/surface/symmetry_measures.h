#pragma once

#include <optional>

#include "surface/assemble.h"

namespace skinforge {

/// How symmetric a junction came out, in mean edges of its new faces.
struct SymmetryMeasures {
  bool faces_symmetric = false;  ///< every face and every new vertex has an image, found along the faces
  double mean = 0, max = 0;      ///< new vertices from the mirrored places of their images
  double border_max = 0;         ///< the same for the borders, which are the inputs' own
};

/// Measures the junction of `site` and its image (`Junction::symmetry`) on the joined surface. Without
/// symmetric faces the image of a new vertex is the nearest. None where the junction is not meant to be
/// symmetric, or has no faces.
std::optional<SymmetryMeasures> measure_symmetry(const JoinedSurface& joined,
                                                 std::span<const Junction> junctions, std::size_t site);

}  // namespace skinforge
