#pragma once

#include <array>
#include <map>
#include <set>
#include <vector>

#include "model/polygon_mesh.h"
#include "testing/gltf_evaluator.h"

namespace skinforge::testing {

/// The edges of a GLB's triangles after welding vertices at exactly the same place in the bind pose.
class WeldedEdges {
 public:
  explicit WeldedEdges(const GltfEvaluator& glb);

  /// Edges of junction faces with one face, with more than two, with two in the same direction.
  std::size_t open_at_junctions() const;
  std::size_t crowded_at_junctions() const;
  std::size_t turned_at_junctions() const;
  /// Edges that have not two faces, anywhere.
  std::size_t odd() const;

 private:
  struct Edge {
    int along = 0, against = 0;  // faces that run from the smaller to the larger vertex, and back
    bool is_of_junction = false;
  };
  template <class Predicate>
  std::size_t count(const Predicate& predicate) const;

  std::map<std::array<std::size_t, 2>, Edge> edges_;
};

/// Edges of a mesh that have not two faces, after welding vertices at exactly the same place.
std::size_t odd_edges(const PolygonMesh& mesh);

}  // namespace skinforge::testing
