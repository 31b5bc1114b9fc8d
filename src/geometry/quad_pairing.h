#pragma once

#include "model/polygon_mesh.h"

namespace skinforge {

struct QuadPairingOptions {
  double min_score = 0.5;  ///< pairs below it stay triangles; see quad_pairing.md for how it was chosen
};

/// Recovers the quads that an artist modelled from a triangulated mesh (glTF stores triangles only): pairs of
/// triangles of one material and part are merged when the quad is convex, nearly flat and well shaped (score
/// = 0.5 * least scaled Jacobian + 0.5 * dot of the two normals), best first, ties by lower edge. UV, normal
/// and colour seams across the diagonal forbid the merge. Vertices, corner attributes and the order of faces
/// are kept (a quad takes the place of its first triangle). Polygons that are no triangles stay.
/// Deterministic; O(n log n).
PolygonMesh recover_quads(const PolygonMesh& mesh, const QuadPairingOptions& options = {});

}  // namespace skinforge
