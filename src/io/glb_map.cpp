#include "io/glb_map.h"

#include "io/glb_geometry.h"

namespace skinforge {

GlbMap glb_map(const Character& character) {
  GlbMap map;
  for (GlbMesh& mesh : glb_meshes(character))
    for (GlbPrimitive& primitive : mesh.primitives)
      map.primitives.push_back({std::move(primitive.vertex), std::move(primitive.faces)});
  return map;
}

}  // namespace skinforge
