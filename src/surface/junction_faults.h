#pragma once

#include <compare>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "surface/junction_loop.h"
#include "surface/kept_surface.h"

namespace skinforge {

/// What a junction must not have (the bold gates of junction.md (c)). Ordered by weight: the first counts
/// most.
struct JunctionFaults {
  std::size_t non_manifold_edges =
      0;  ///< edges of the patch that it and the preserved faces use more than twice
  std::size_t self_intersections = 0;  ///< pairs of triangles with one of the patch
  std::size_t degenerate_faces = 0;    ///< area below 1e-6 of a squared edge

  JunctionFaults& operator+=(const JunctionFaults& other);
  auto operator<=>(const JunctionFaults&) const = default;
  bool any() const { return *this != JunctionFaults(); }

  template <class Archive>
  friend void fields(Archive& a, JunctionFaults& f) {
    a(f.non_manifold_edges, f.self_intersections, f.degenerate_faces);
  }
};

/// "0 non-manifold edges, 2 self-intersections, 0 degenerate faces".
std::string describe(const JunctionFaults& faults);

/// Preserved faces that a patch cuts.
std::vector<std::pair<SourceId, FaceId>> faces_cut_by(const TrianglePatch& patch,
                                                      const std::vector<JunctionLoop>& loops,
                                                      const KeptSurface& kept);

/// Triangles of a patch that intersect others, or preserved faces.
std::set<std::int32_t> intersecting_triangles(const TrianglePatch& patch,
                                              const std::vector<JunctionLoop>& loops,
                                              const KeptSurface& kept);

/// Faults of a patch whose fixed vertices are those of `loops`, among the preserved faces.
JunctionFaults faults_of(const TrianglePatch& patch, const std::vector<JunctionLoop>& loops,
                         const KeptSurface& kept);

}  // namespace skinforge
