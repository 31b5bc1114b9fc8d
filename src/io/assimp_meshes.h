#pragma once

#include <assimp/scene.h>

#include <map>
#include <vector>

#include "io/raw_scene.h"

namespace skinforge {

/// Index of each Assimp node in `RawScene::nodes`.
using NodeIndex = std::map<const aiNode*, std::int32_t>;

/// Gives the scene one mesh and, where there are bones, one skin for each node that has meshes. `geometric`
/// has, per node of the scene, what its vertices go through first. `material` maps Assimp's materials to
/// those of the scene
/// (-1 = none). Points and lines are left out with an issue.
void read_meshes(const aiScene& source, const NodeIndex& index, const std::vector<Affine3>& geometric,
                 const std::vector<std::int32_t>& material, RawScene& scene);

}  // namespace skinforge
