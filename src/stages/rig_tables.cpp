#include "stages/rig_tables.h"

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"
#include "io/plain_mesh.h"

namespace skinforge {
namespace {

// The bone of each joint; -1 for joints that are no bone of the file.
std::vector<Eigen::Index> bone_of_joint(const Rigged& rigged) {
  std::vector<Eigen::Index> bone(rigged.character.skeleton.size(), -1);
  for (std::size_t k = 0; k < rigged.joint_of_bone.size(); ++k)
    bone[rigged.joint_of_bone[k].index()] = static_cast<Eigen::Index>(k);
  return bone;
}

}  // namespace

Pose read_pose(const InputFile& file, const Rigged& rigged) {
  const RotationFrames frames = read_frames(file, rigged);
  if (frames.frames.size() != 1)
    throw Error(ExitCode::BadInput,
                fmt::format("{}: {} frames; a pose has one", printable(file.path), frames.frames.size()));
  const std::vector<Quat> local =
      local_rotations({rigged.character.skeleton, rigged.joint_of_bone}, frames.frames[0]);
  Pose pose = bind_pose(rigged.character.skeleton);
  for (std::size_t j = 0; j < pose.size(); ++j) pose[j].rotation = local[j];
  return pose;
}

std::vector<Vec3> read_shape(const InputFile& file, const Rigged& rigged) {
  const std::vector<Vec3> positions = read_plain_mesh(file).positions;
  if (positions.size() != rigged.vertex_of_file.size())
    throw Error(ExitCode::BadInput, fmt::format("{}: {} vertices, the model has {}", printable(file.path),
                                                positions.size(), rigged.vertex_of_file.size()));
  std::vector<Vec3> shape = rigged.character.mesh.positions;
  for (std::size_t i = 0; i < positions.size(); ++i) shape[rigged.vertex_of_file[i].index()] = positions[i];
  return shape;
}

Eigen::MatrixXd weight_table(const Rigged& rigged) {
  const std::vector<Eigen::Index> bone = bone_of_joint(rigged);
  Eigen::MatrixXd table = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(rigged.vertex_of_file.size()),
                                                static_cast<Eigen::Index>(rigged.joint_of_bone.size()));
  for (std::size_t i = 0; i < rigged.vertex_of_file.size(); ++i)
    for (const Influence& w : rigged.character.weights.of(rigged.vertex_of_file[i]))
      if (bone[w.joint.index()] >= 0) table(static_cast<Eigen::Index>(i), bone[w.joint.index()]) = w.weight;
  return table;
}

Eigen::MatrixXd handle_table(const Rigged& rigged) {
  const std::vector<Eigen::Index> bone = bone_of_joint(rigged);
  Eigen::MatrixXd table(static_cast<Eigen::Index>(rigged.vertex_of_file.size()), 1);
  for (std::size_t i = 0; i < rigged.vertex_of_file.size(); ++i) {
    const JointId joint = rigged.handles[rigged.vertex_of_file[i].index()];
    table(static_cast<Eigen::Index>(i), 0) =
        joint.is_valid() ? static_cast<double>(bone[joint.index()]) : -1.0;
  }
  return table;
}

}  // namespace skinforge
