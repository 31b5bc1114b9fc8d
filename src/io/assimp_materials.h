#pragma once

#include <assimp/scene.h>

#include <vector>

#include "io/memory_io_system.h"
#include "io/raw_scene.h"

namespace skinforge {

/// Appends the materials and images to the scene; returns the place of each Assimp material, -1 for the
/// stand-in that Assimp adds to files without materials. Classic materials (Phong, Lambert) become rough
/// dielectrics.
std::vector<std::int32_t> read_materials(const aiScene& source, bool is_fbx, const MemoryIoSystem& files,
                                         RawScene& scene);

}  // namespace skinforge
