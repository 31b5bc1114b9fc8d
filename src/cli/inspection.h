#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "base/issue.h"
#include "io/raw_scene.h"
#include "model/character.h"

namespace skinforge {

/// What a model holds, in numbers. Lengths in metres.
struct Inspection {
  std::string file;
  std::string digest;
  std::uint64_t bytes = 0;
  double metres_per_unit = 1;                    ///< of the file
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();  ///< box of the bind pose
  std::size_t faces = 0, vertices = 0, triangles = 0, quads = 0, larger_faces = 0;
  std::size_t components = 0, open_edges = 0, edges_of_many_faces = 0;
  std::vector<std::size_t> influences;  ///< [n]: vertices with n influences
  std::size_t joints_without_weights = 0;
  double default_pose_distance =
      0;  ///< farthest that a joint of the file's default pose is from its bind position
  std::string default_pose_joint;  ///< that joint
  std::vector<Issue> issues;
};

/// Counts everything; empty meshes give zeros. `scene`: what the character was built from.
Inspection inspect(const Character& character, const RawScene& scene);

/// For people: a few headed blocks, the joint tree indented.
std::string inspection_text(const Inspection& inspection, const Character& character);
/// The same for programs, with every joint, clip, material and image.
nlohmann::json inspection_json(const Inspection& inspection, const Character& character);

}  // namespace skinforge
