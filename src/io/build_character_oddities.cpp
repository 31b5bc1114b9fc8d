#include "io/build_character_oddities.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <set>

namespace skinforge {
namespace {

constexpr double kOnePlace = 1e-6;  // of the mesh's diagonal, as for welding

std::size_t doubled_faces(const PolygonMesh& mesh) {
  std::set<std::vector<VertexId>> seen;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(FaceId(f));
    std::vector<VertexId> vertices(face.begin(), face.end());
    std::sort(vertices.begin(), vertices.end());
    seen.insert(std::move(vertices));
  }
  return mesh.face_count() - seen.size();
}

/// The joints whose scale in the file's pose is odd.
template <class IsOdd>
std::vector<JointId> joints_where(const JointTable& joints, const IsOdd& is_odd) {
  std::vector<JointId> found;
  for (std::size_t j = 0; j < joints.skeleton.size(); ++j)
    if (is_odd(joints.rest[j].scale)) found.emplace_back(j);
  return found;
}

/// In the file's pose or in the bind pose.
bool stand_at_one_place(const JointTable& joints, double tolerance) {
  Eigen::AlignedBox3d box;
  bool has_steps = false;  // from a joint to the next, in the file's pose
  for (std::size_t j = 0; j < joints.skeleton.size(); ++j) {
    const Joint& joint = joints.skeleton.joints[j];
    box.extend(Vec3(joint.joint_from_model.inverse().translation()));
    has_steps |= joint.parent.is_valid() && !joints.rest[j].translation.isZero(0);
  }
  return joints.skeleton.size() > 1 && (!has_steps || box.diagonal().norm() <= tolerance);
}

}  // namespace

void report_oddities(const PolygonMesh& mesh, const JointTable& joints, const std::string& place,
                     IssueSink& issues) {
  if (const std::size_t doubled = doubled_faces(mesh); doubled > 0)
    issues.warn("faces-doubled", place,
                fmt::format("{} faces lie on others with the same vertices", doubled));
  const auto is_flat = [](const Vec3& scale) { return (scale.array() == 0).any(); };
  const auto is_mirrored = [](const Vec3& scale) { return scale.prod() < 0; };
  if (const auto flat = joints_where(joints, is_flat); !flat.empty())
    issues.warn("joints-flat", place,
                fmt::format("{} joints have a scale of 0 in the file's pose, first \"{}\"", flat.size(),
                            joints.skeleton[flat[0]].name));
  if (const auto mirrored = joints_where(joints, is_mirrored); !mirrored.empty())
    issues.warn("joints-mirrored", place,
                fmt::format("{} joints are mirrored in the file's pose, first \"{}\"", mirrored.size(),
                            joints.skeleton[mirrored[0]].name));
  if (stand_at_one_place(joints, kOnePlace * mesh.diagonal()))
    issues.warn("joints-at-one-place", place,
                fmt::format("all {} joints stand at one place", joints.skeleton.size()));
}

bool is_oddity(std::string_view code) {
  return code == "faces-doubled" || code == "joints-flat" || code == "joints-mirrored" ||
         code == "joints-at-one-place";
}

}  // namespace skinforge
