#pragma once

#include <vector>

#include "geometry/edges.h"
#include "model/polygon_mesh.h"

namespace skinforge {

/// A run of edges along which kept faces end and discarded ones begin, in the direction in which a new face
/// would run.
struct BorderChain {
  std::vector<VertexId> vertices;  ///< one more than edges for an arc, as many as edges for a loop
  bool is_closed = true;           ///< false: an arc that ends on an original open border of the mesh
};

/// Faces that stay, one flag per face.
using FaceSet = std::vector<char>;

/// Chains between the kept faces and the discarded ones. Edges that were open in the mesh are no border.
/// Every vertex lies on at most one chain if `drop_pinches` ran before. Loops start at their lowest vertex;
/// chains are sorted by first vertex.
std::vector<BorderChain> border_chains(const PolygonMesh& mesh, const EdgeList& edges, const FaceSet& kept);

/// Removes kept faces until no vertex lies on more than one run of the border: at a pinch the smaller fans
/// go.
void drop_pinches(const PolygonMesh& mesh, const EdgeList& edges, FaceSet& kept);

/// Morphological opening (Roessl 2000; SkinMixer Sec. 6): strips and spikes of kept faces that are one face
/// wide at the border go.
void open_face_set(const PolygonMesh& mesh, const EdgeList& edges, FaceSet& kept);

/// Makes the border run straight along the edge flow: a kept quad with two or more border edges, and a kept
/// triangle whose removal shortens the border, go, until nothing changes or `max_loss` faces are gone
/// (junction.md b.0, step 3). Returns the number removed.
int straighten_border(const PolygonMesh& mesh, const EdgeList& edges, FaceSet& kept, int max_loss);

/// Crumbs that no one would sign go: groups of kept faces (connected by edges) that touch the border and have
/// fewer than `least_faces` faces, or, beside one twenty times as large, no more faces than border edges.
void drop_crumbs(const PolygonMesh& mesh, const EdgeList& edges, FaceSet& kept, int least_faces);

/// Gives groups of kept faces that fell apart since `before`, or have more borders than before, their faces
/// back: three claws on what is left of a foot are one part with one border, however narrow the foot is
/// between them.
void restore_broken_groups(const PolygonMesh& mesh, const EdgeList& edges, const FaceSet& before,
                           FaceSet& kept);

}  // namespace skinforge
