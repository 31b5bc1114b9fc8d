#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "surface/junction_loop.h"
#include "surface/triangle_patch.h"

namespace skinforge {

/// A strip between two borders that end on open hems of their inputs (junction.md, failure cases): where a
/// coat or a leaf is cut from hem to hem. Its own ends go on where those hems end.
struct ArcStrip {
  std::vector<JunctionLoop> arcs;  ///< of the host and of the donor, not closed
  TrianglePatch patch;             ///< its fixed vertices are those of the arcs
  std::size_t quads = 0;           ///< triangles 2 k and 2 k + 1 are halves of a quad, for k below this
  std::size_t hem_edges = 0;       ///< open by design

  template <class Archive>
  friend void fields(Archive& a, ArcStrip& s) {
    a(s.arcs, s.patch.positions, s.patch.triangles, s.patch.fixed, s.quads, s.hem_edges);
  }
};

/// Rows of quads from one arc to the other, leaving both as their neighbours arrive; where the counts differ
/// by d, the last row has d triangles.
ArcStrip arc_strip(const JunctionLoop& host, const JunctionLoop& donor);

/// Strips between arcs of the host and of the donor, the two that run nearest to each other first. What finds
/// no other stays open; `open` counts it.
std::vector<ArcStrip> arc_strips(std::span<const JunctionLoop> arcs, int& open);

}  // namespace skinforge
