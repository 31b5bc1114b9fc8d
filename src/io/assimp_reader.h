#pragma once

#include <memory>
#include <vector>

#include "io/import.h"

namespace skinforge {

/// A scene, and what it was read from: freeing that takes a tenth of the time that reading took.
struct AssimpScene {
  RawScene scene;
  std::shared_ptr<void> source;
};

/// A file of any format that Assimp 5.2.5 reads (FBX, COLLADA, OBJ, PLY, STL, BLEND, ...; not glTF,
/// which it reads wrongly) as it is. Meshes that Assimp split by material are one mesh again, one per node;
/// polygons stay polygons; key times are seconds; UVs point down as in glTF. An FBX keeps its units and axes,
/// and `metres_from_file` says how to leave them; the geometric transform of an FBX node is moved into its
/// vertices. Images come from inside the file or from `files`; others are left out with an issue.
/// Memory-unsafe on hostile input: call through `sandbox.h`. Throws Error (BadInput) without the path, and
/// with the bytes of the file where Assimp quotes them.
AssimpScene read_with_assimp(const std::vector<InputFile>& files);

}  // namespace skinforge
