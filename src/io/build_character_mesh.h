#pragma once

#include <string>
#include <vector>

#include "base/issue.h"
#include "io/build_character_joints.h"
#include "model/character.h"

namespace skinforge {

/// Fills mesh, weights and morph targets of `character` (whose skeleton is that of `joints`) from all mesh
/// nodes of the scene: `build_character.md`, steps 4 to 6. Returns the part of each node; invalid = no mesh.
std::vector<PartId> build_mesh(const RawScene& scene, const BoundScene& bound, const JointTable& joints,
                               const std::string& place, Character& character, IssueSink& issues);

}  // namespace skinforge
