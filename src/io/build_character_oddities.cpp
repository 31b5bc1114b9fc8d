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

/// One warning for all joints of which `is_odd` holds, by their number and the first name.
template <class IsOdd>
void report_joints(const JointTable& joints, const std::string& code, const char* what, const IsOdd& is_odd,
                   const std::string& place, IssueSink& issues) {
  std::size_t count = 0, first = 0;
  for (std::size_t j = joints.skeleton.size(); j-- > 0;)
    if (is_odd(joints.rest[j].scale)) ++count, first = j;
  if (count > 0)
    issues.warn(code, place,
                fmt::format("{} joints {} in the file's pose, first \"{}\"", count, what,
                            joints.skeleton[JointId(first)].name));
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
  report_joints(joints, "joints-flat", "have no extent along an axis", is_flat, place, issues);
  report_joints(joints, "joints-mirrored", "are mirrored", is_mirrored, place, issues);
  if (stand_at_one_place(joints, kOnePlace * mesh.diagonal()))
    issues.warn("joints-at-one-place", place,
                fmt::format("all {} joints stand at one place", joints.skeleton.size()));
}

}  // namespace skinforge
