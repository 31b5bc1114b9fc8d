#pragma once

#include <vector>

#include "geometry/triangle_bvh.h"
#include "model/polygon_mesh.h"

namespace skinforge {

/// Triangles and query structures of all placed sources, by SourceId. Refers to the meshes.
class PlacedSurfaces {
 public:
  explicit PlacedSurfaces(const std::vector<PolygonMesh>& placed);

  std::size_t count() const { return placed_->size(); }
  const PolygonMesh& mesh(std::size_t source) const { return (*placed_)[source]; }
  const Triangulation& triangles(std::size_t source) const { return triangulations_[source]; }
  const TriangleBvh& bvh(std::size_t source) const { return bvhs_[source]; }

 private:
  const std::vector<PolygonMesh>* placed_;
  std::vector<Triangulation> triangulations_;
  std::vector<TriangleBvh> bvhs_;
};

}  // namespace skinforge
