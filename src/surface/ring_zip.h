#pragma once

#include <span>
#include <vector>

#include "surface/triangle_patch.h"
#include "surface/wanted_surface.h"

namespace skinforge {

/// Triangles that close the ring between two loops that run the same way: exactly #a + #c of them, each with
/// one edge on one of the loops (Fuchs 1977, contour triangulation), of least total cost by dynamic
/// programming over all starts near the closest pair. Cost of a triangle: its area, plus a twentieth of its
/// longest edge squared, more when it faces inwards. Orientation: runs along `a` forwards and along `c`
/// backwards. Indices: 0.. for a, #a.. for c. Both loops need 3 or more vertices. O(starts * #a * #c).
std::vector<Triangle> zip_rings(std::span<const Vec3> a, std::span<const Vec3> c,
                                const OutwardDirection& outward);

/// Triangles that fill one loop: #loop - 2 of them, least total area (ties: lowest apex) by dynamic
/// programming. They run along the loop forwards. O(#loop cubed); loops above 256 vertices are filled by a
/// fan about their first vertex.
std::vector<Triangle> fill_loop(std::span<const Vec3> loop);

}  // namespace skinforge
