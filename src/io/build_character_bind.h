#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/issue.h"
#include "io/raw_scene.h"

namespace skinforge {

/// A scene whose bind pose is known. "File space" is the world of the file's nodes, before
/// `metres_from_file`.
struct BoundScene {
  std::vector<RawScene::Node> nodes;  ///< those of the scene, then helpers for second bind matrices
  std::vector<std::size_t> order;     ///< all nodes, parents first, otherwise by index
  std::vector<Affine3> bind;          ///< per node, file_from_node in the bind pose
  std::vector<std::optional<Affine3>> node_from_file;  ///< inverse bind matrix of the nodes that a skin binds
  std::vector<Affine3> skin_place;                     ///< per skin, file_from_mesh of its vertices
  std::vector<std::vector<std::int32_t>> skin_nodes;   ///< per skin, the node of each of its joints
};

/// Finds the bind pose of a checked scene: `build_character.md`, steps 1 and 2. Issues start with `place`.
BoundScene bind_scene(const RawScene& scene, const std::string& place, IssueSink& issues);

}  // namespace skinforge
