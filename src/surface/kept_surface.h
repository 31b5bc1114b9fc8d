#pragma once

#include <span>
#include <vector>

#include "geometry/triangle_bvh.h"
#include "surface/preserved.h"

namespace skinforge {

/// All preserved faces of all sources as triangles: what a junction must keep clear of.
struct KeptSurface {
  std::vector<Vec3> positions;                      ///< of all vertices of all sources, source after source
  std::vector<Triangle> triangles;                  ///< of preserved faces
  std::vector<std::pair<SourceId, FaceId>> origin;  ///< per triangle
  std::vector<std::int32_t> first;                  ///< per source: index of its vertex 0
  TriangleBvh bvh{{}, {}};                          ///< over `triangles`

  std::int32_t vertex(SourceId source, VertexId v) const { return first[source.index()] + v.value; }
};

KeptSurface kept_surface(std::span<const PreservedSource> sources);

}  // namespace skinforge
