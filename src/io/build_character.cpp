#include "io/build_character.h"

#include <filesystem>

#include "base/error.h"
#include "base/text.h"
#include "io/build_character_bind.h"
#include "io/build_character_clips.h"
#include "io/build_character_joints.h"
#include "io/build_character_mesh.h"
#include "io/build_character_oddities.h"
#include "io/import.h"
#include "io/raw_scene_check.h"

namespace skinforge {

Character settle_scene(const RawScene& scene, const std::string& place, IssueSink& issues) {
  check_raw_scene(scene);
  for (const Issue& issue : scene.issues) issues.add(issue);
  if (scene.nodes.empty()) throw Error(ExitCode::BadInput, "nothing in it: no mesh, no joint");
  const BoundScene bound = bind_scene(scene, place, issues);
  JointTable joints = build_joints(scene, bound, place, issues);
  Character character;
  character.name = std::filesystem::path(place).stem().string();
  character.materials = scene.materials;
  character.images = scene.images;
  const std::vector<PartId> parts = build_mesh(scene, bound, joints, place, character, issues);
  report_oddities(character.mesh, joints, place, issues);
  character.clips = build_clips(scene, joints, parts, place, issues);
  character.skeleton = std::move(joints.skeleton);
  if (character.mesh.face_count() == 0 && character.clips.empty())
    throw Error(ExitCode::BadInput, "nothing to use in it: no face and no clip");
  validate(character);
  return character;
}

Character build_character(const RawScene& scene, const std::string& place, IssueSink& issues) {
  return with_context(printable(place), [&] { return settle_scene(scene, place, issues); });
}

}  // namespace skinforge
