#pragma once

#include <string>
#include <vector>

#include "base/issue.h"
#include "io/build_joints.h"
#include "model/character.h"

namespace skinforge {

/// The mesh side of a character.
struct SceneMesh {
  PolygonMesh mesh;
  SkinWeights weights;
  std::vector<MorphTarget> morphs;
  std::vector<PartId> part_of_node;
};

/// All meshes of a scene in the bind pose, welded, with sound weights (build_character.md, step 4): skinned
/// vertices where their skin binds them, rigid parts where their joint is bound and carried by it alone.
SceneMesh build_mesh(const RawScene& scene, const SceneJoints& joints, const std::string& place,
                     IssueSink& issues);

}  // namespace skinforge
