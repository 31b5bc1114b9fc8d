#pragma once

#include <vector>

#include "model/character.h"

namespace skinforge {

/// Which vertex and face of the character each vertex and triangle of its GLB shows, for what is drawn over
/// it.
struct GlbMap {
  struct Primitive {
    std::vector<VertexId> vertices;  ///< per vertex of the primitive
    std::vector<FaceId> faces;       ///< per triangle
  };
  std::vector<Primitive> primitives;  ///< in the order of the file, mesh after mesh
};

/// Of the file that `write_glb` makes of this character.
GlbMap glb_map(const Character& character);

}  // namespace skinforge
