#pragma once

#include <optional>
#include <vector>

#include "field/signed_distance.h"
#include "surface/assemble.h"

namespace skinforge {

/// What junction.md section (c) asks of one junction, measured on the joined surface.
struct JunctionMeasures {
  std::size_t faces = 0, quads = 0, triangles = 0;
  std::size_t components = 0;          ///< of the junction's own faces
  std::size_t boundary_edges = 0;      ///< edges of its faces that no other face shares
  std::size_t non_manifold_edges = 0;  ///< edges of its faces that more than two faces share
  std::size_t degenerate_faces = 0;
  std::size_t folded_faces = 0;        ///< facing against the field's gradient; 0 without a field
  std::size_t self_intersections = 0;  ///< pairs with a junction triangle
  std::size_t irregular_vertices =
      0;  ///< new vertices whose valence is neither 4 (among quads) nor 6 (among triangles)
  std::vector<double> scaled_jacobian;  ///< per face, in [-1, 1]
  std::vector<double>
      deviation;  ///< per new vertex and face centre, |delta_R| in voxels; empty without a field
  std::vector<double>
      edge_length_ratio;  ///< per border edge: mean of the new edges at its ends over its own length
  std::vector<double> border_dihedral;  ///< per border edge, radians, between the preserved and the new face
  std::vector<double>
      border_normal_step;  ///< per end of each border edge, radians, between the corner normals
};

/// Measures the junction of `site`. `field` may be null or empty.
JunctionMeasures measure_junction(const JoinedSurface& joined, std::int32_t site, const DistanceField* field);

/// Edges with one face, and with more than two, over the preserved faces alone: what the inputs brought
/// along, away from junctions.
struct InheritedEdges {
  std::size_t open = 0, non_manifold = 0;
};
InheritedEdges inherited_edges(const JoinedSurface& joined);

}  // namespace skinforge
