#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/id.h"
#include "surface/fairing.h"
#include "surface/site_field.h"

namespace skinforge {

/// A closed border of a preserved mesh that a junction must meet, in the direction in which new faces run
/// along it.
struct JunctionLoop {
  SourceId source;
  bool is_host = false;
  std::vector<VertexId> vertices;  ///< of that source's mesh
  std::vector<Vec3> positions;     ///< placed, metres
  std::vector<std::vector<Vec3>>
      inward;  ///< per vertex: its neighbours on preserved faces that are not on the loop

  template <class Archive>
  friend void fields(Archive& a, JunctionLoop& l) {
    a(l.source, l.is_host, l.vertices, l.positions, l.inward);
  }
};

/// How a junction was made: the ladder of junction.md, best rung first.
enum class JunctionRung : std::uint8_t {
  Field,   ///< isosurface of the blended field, zipped to the borders (rung 1)
  Bridge,  ///< the borders zipped directly, the strip remeshed and faired
  Cap,     ///< each border closed on its own
  None,    ///< no border: parts without a cut loop are joined rigidly
};

/// M_J for one operation (SkinMixer Sec. 6.1): triangles whose fixed vertices are the vertices of `loops`,
/// loop after loop.
struct Junction {
  std::vector<JunctionLoop> loops;
  TrianglePatch patch;
  JunctionRung rung = JunctionRung::None;
  std::string reason;  ///< why not a better rung; empty for Field, and for Cap where nothing else was asked
  double voxel = 0;    ///< metres; 0 without a field

  template <class Archive>
  friend void fields(Archive& a, Junction& j) {
    a(j.loops, j.patch.positions, j.patch.triangles, j.patch.fixed, j.rung, j.reason, j.voxel);
  }
};

/// Builds the surface between the loops. `kept`: all preserved triangles near the site, for trimming the
/// isosurface clear of them. Rungs are tried from the best; watertight on every rung, because loops enter as
/// indices and every ring is closed by triangles that use each of its edges exactly once.
Junction build_junction(std::vector<JunctionLoop> loops, const SiteField& field, const TriangleBvh& kept);

}  // namespace skinforge
