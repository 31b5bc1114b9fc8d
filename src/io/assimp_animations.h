#pragma once

#include <assimp/scene.h>

#include "io/assimp_meshes.h"
#include "io/raw_scene.h"

namespace skinforge {

/// Appends the animations: every key, times in seconds. Channels of unknown nodes become issues.
void read_animations(const aiScene& source, const NodeIndex& index, RawScene& scene);

}  // namespace skinforge
