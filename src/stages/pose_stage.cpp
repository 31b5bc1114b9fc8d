#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "skeleton/pose.h"
#include "skinning/linear_blend.h"
#include "stages/inputs.h"
#include "stages/stages.h"

namespace skinforge {
namespace {

/// Poses an input before it is mixed (Sec. 4.1, Fig. 3): the posed shape becomes the new bind pose.
class PoseInput final : public Stage {
 public:
  PoseInput(ArtifactNames names, const RecipeInput& input)
      : names_(std::move(names)), input_(input.name), changes_(input.pose) {}

  StageInfo info() const override {
    return {.name = "pose",
            .instance = input_,
            .version = 1,
            .reads = {names_.imported(input_)},
            .writes = {names_.character(input_)}};
  }
  void add_to_key(Hasher& key) const override { key.add_value("pose", changes_); }

  void run(const StageInput& in, StageOutput& out, IssueSink&) const override {
    if (changes_.empty()) return out.pass(names_.character(input_), in, names_.imported(input_));
    Character character = in.get<Character>(names_.imported(input_));
    pose(character);
    out.put(names_.character(input_), std::move(character));
  }

 private:
  void pose(Character& character) const {
    Skeleton& skeleton = character.skeleton;
    Pose local = bind_pose(skeleton);
    for (const auto& [name, change] : changes_) {
      const JointId joint = require_joint(skeleton, name, input_);
      const JointId parent = skeleton[joint].parent;
      const Vec3 move(change.translate[0], change.translate[1], change.translate[2]);
      local[joint.index()].rotation = local[joint.index()].rotation * rotation_yxz(change.rotate_deg);
      local[joint.index()].translation +=
          parent.is_valid() ? Vec3(skeleton[parent].joint_from_model.linear() * move) : move;
    }
    const std::vector<Affine3> palette = skinning_palette(skeleton, local);
    pose_normals(character, palette);
    character.mesh.positions = linear_blend(character.mesh.positions, character.weights, palette);
    const std::vector<Affine3> placed = model_from_joint(skeleton, local);
    for (std::size_t j = 0; j < skeleton.size(); ++j) {
      skeleton.joints[j].bind = local[j];
      skeleton.joints[j].joint_from_model = placed[j].inverse();
    }
  }

  static void pose_normals(Character& character, const std::vector<Affine3>& palette) {
    PolygonMesh& mesh = character.mesh;
    mesh.normals = linear_blend_normals(mesh.normals, mesh.corners, character.weights, palette);
    for (SplitNormals& split : mesh.split) {
      const std::array<VertexId, 2> ends{mesh.face(split.face)[0], mesh.face(split.face)[2]};
      for (auto* normals : {&split.first, &split.second}) {
        const auto posed = linear_blend_normals(*normals, ends, character.weights, palette);
        std::copy(posed.begin(), posed.end(), normals->begin());
      }
    }
  }

  ArtifactNames names_;
  std::string input_;
  std::map<std::string, PoseChange> changes_;
};

}  // namespace

StagePointer make_pose_stage(const ArtifactNames& names, const RecipeInput& input) {
  return std::make_unique<PoseInput>(names, input);
}

}  // namespace skinforge
