#pragma once

#include "model/polygon_mesh.h"

namespace skinforge {

struct QuadPairingOptions {
  double min_score = 0.5;  ///< pairs below it stay triangles; see quad_pairing.md for how it was chosen
  /// Added when ranking two triangles that follow each other in the file, as exporters write the halves of a
  /// quad; 0 where the order of triangles means nothing. Measured, see quad_pairing.md.
  double follower_bonus = 0.2;
};

/// Recovers the quads that an artist modelled from a triangulated mesh (glTF stores triangles only): pairs of
/// triangles of one material and part are merged when the quad is convex, nearly flat and well shaped (score
/// = 0.5 * least scaled Jacobian + 0.5 * dot of the two normals), best first, ties by lower edge. UV and
/// colour seams across the diagonal forbid the merge; normals that differ do not, or a flat-shaded mesh would
/// have no quads. A quad takes the place of its first triangle and begins at an end of the lost diagonal, so
/// a fan from its first corner gives both triangles back. Vertices, the order of faces and corner attributes
/// are kept; where the normals of the two triangles differ at an end of the diagonal, the corner gets the
/// unit vector of their sum, and `split` keeps them. Polygons that are no triangles stay. Deterministic; O(n
/// log n). Page: quad_pairing.md.
PolygonMesh recover_quads(const PolygonMesh& mesh, const QuadPairingOptions& options = {});

}  // namespace skinforge
