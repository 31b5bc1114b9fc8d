#pragma once

#include <vector>

#include "base/id.h"
#include "base/math.h"

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

}  // namespace skinforge
