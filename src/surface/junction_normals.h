#pragma once

#include <span>

#include "surface/assemble.h"

namespace skinforge {

/// Gives the corners of one junction their normals. At the border they are those of the preserved face across
/// the border edge, so that shading does not step there, unless the input was hard along that edge (its
/// normals on both sides of it differed): then the junction's own. Where a hard edge of the input ends at the
/// border, each face of the junction takes the side it turns to. Where the input is flat shaded, faces are
/// flat. Inside, normals are smooth, or flat where most of the border is.
void shade_junction(JoinedSurface& result, std::span<const PreservedSource> sources, std::int32_t site);

/// Angles in radians between the normals of the preserved and the new face at both ends of each border edge
/// of a junction: 0 where the shading does not step.
std::vector<double> border_normal_steps(const JoinedSurface& result, std::int32_t site);

/// The normal that face `f` shows at its corner `corner` along the side that leaves corner `side`, both
/// counted within the face: of a quad that was two triangles, that of the triangle with that side.
Vec3 normal_along(const PolygonMesh& mesh, FaceId f, std::size_t corner, std::size_t side);

}  // namespace skinforge
