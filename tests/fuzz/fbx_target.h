#pragma once

#include "base/error.h"
#include "fuzz/input.h"
#include "io/fbx_animation.h"
#include "io/fbx_scene.h"
#include "io/raw_scene_check.h"

namespace skinforge::fuzz {

inline Vec3Track keys_at(double begin, double end, const Vec3& value) {
  Vec3Track track;
  track.times = {begin, end};
  track.values = {value, value};
  return track;
}

/// Stands in for Assimp, which is not ours to fuzz: each node in its default pose, each stack a clip that
/// holds all of them still for a second.
inline RawScene imported(const FbxScene& fbx) {
  RawScene scene;
  std::vector<RawScene::NodeTracks> tracks;
  for (const std::int64_t id : fbx.all("Model")) {
    const FbxTransform t(*fbx.object(id));
    RawScene::Node node;
    node.name = fbx.name(id);
    node.local = t.local(t.translation, t.rotation_deg, t.scale);
    RawScene::NodeTracks still;
    still.node = static_cast<std::int32_t>(scene.nodes.size());
    still.translation = keys_at(0, 1, node.local.translation);
    tracks.push_back(std::move(still));
    scene.nodes.push_back(std::move(node));
  }
  for (const std::int64_t id : fbx.all("AnimationStack")) scene.animations.push_back({fbx.name(id), tracks});
  return scene;
}

/// Our own reading of FBX files: before Assimp, and after it what it leaves out. What comes out of the child
/// is checked like every scene.
inline void feed_fbx(std::span<const std::byte> bytes) {
  const InputFile file = file_of("a.fbx", bytes);
  const FbxFile fbx = parse_fbx(file.bytes);
  const FbxScene scene(fbx.root);
  check_fbx(scene);
  RawScene raw = imported(scene);
  restore_fbx_curves(scene, raw);
  check_raw_scene(raw);
}

}  // namespace skinforge::fuzz
