#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/fbx_document.h"
#include "model/transform.h"

namespace skinforge {

/// The objects of an FBX file and how they hang together. A connection that the file says again is one here:
/// what follows connections takes the product of how many there are.
class FbxScene {
 public:
  /// Refers to `root`, which must outlive it.
  explicit FbxScene(const FbxNode& root);

  struct Link {
    std::int64_t object = 0;
    std::string property;   ///< empty for object to object
    std::size_t times = 1;  ///< that the file says it
  };

  /// The first object of that id; null when there is none.
  const FbxNode* object(std::int64_t id) const;
  /// Objects of one class ("Model", "AnimationStack", ...) in the order of the file, each id once.
  std::vector<std::int64_t> all(const std::string& node_name) const;
  /// What is connected to an object: its children and sources.
  const std::vector<Link>& sources(std::int64_t id) const;
  /// What an object is connected to: its parents and targets.
  const std::vector<Link>& targets(std::int64_t id) const;
  /// Name without class: "Model::Hips" and "Hips\0\1Model" are "Hips".
  std::string name(std::int64_t id) const;
  /// Frames per second by the global settings.
  double frame_rate() const;

 private:
  const FbxNode& root_;
  std::map<std::int64_t, const FbxNode*> objects_;
  std::map<std::int64_t, std::vector<Link>> sources_, targets_;
};

/// Whether a node's Properties70 has the property.
bool fbx_has(const FbxNode& object, const std::string& property);
/// Values of a property in a node's Properties70; `fallback` or none when it is not there.
Vec3 fbx_vector(const FbxNode& object, const std::string& property, const Vec3& fallback);
std::optional<double> fbx_number(const FbxNode& object, const std::string& property);

/// How an FBX node makes its local transform out of translation, Euler angles and scale: pivots, offsets,
/// pre- and post-rotation (FBX SDK, FbxNode, "transformation matrix"). The geometric transform is not part of
/// it.
struct FbxTransform {
  explicit FbxTransform(const FbxNode& model);

  Transform local(const Vec3& translation, const Vec3& rotation_deg, const Vec3& scale) const;
  bool has_pivots() const;
  double reach() const;  ///< the longest of its vectors

  Vec3 translation, rotation_deg, scale;  ///< of the file's default pose
  Vec3 rotation_offset, rotation_pivot, scaling_offset, scaling_pivot;
  Quat before, after;  ///< pre-rotation, inverse post-rotation
  int order = 0;       ///< 0 XYZ, 1 XZY, 2 YZX, 3 YXZ, 4 ZXY, 5 ZYX: the first axis turns first
};

/// Refuses what Assimp reads silently or falls over: nodes that are their own ancestors or become more than a
/// scene may have, faces and clusters that name vertices which are not there, their arrays when damaged or
/// not as long as they say, over ten million vertices. Throws Error (BadInput).
void check_fbx(const FbxScene& scene);

}  // namespace skinforge
