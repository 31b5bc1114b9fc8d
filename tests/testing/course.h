#pragma once

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/number_table.h"
#include "io/plain_mesh.h"
#include "io/tgf_reader.h"
#include "model/polygon_mesh.h"
#include "model/skin_weights.h"
#include "skeleton/bone_forest.h"
#include "skeleton/rotation_frames.h"
#include "testing/assets.h"

namespace skinforge::testing {

using VertexTriangles = std::vector<std::array<VertexId, 3>>;

/// A character of the course's data (shared folder, assignment6/README.md) and the reference arrays of one of
/// its cases, which two programs that are not ours agree on to 1e-12.
class CourseCase {
 public:
  explicit CourseCase(const std::string& name) : name_(name), given_(read_json("weights.json")) {
    mesh = read_plain_mesh(file(given_["inputs"]["mesh"]));
    triangles = triangulate(mesh).triangles;
    const BoneGraph graph = read_tgf(file(given_["inputs"]["skeleton"]));
    forest = make_bone_forest(graph);
    if (given_["inputs"].contains("pose"))
      frames = rotation_frames(read_dmat(file(given_["inputs"]["pose"])), forest.size());
    if (given_["inputs"].contains("handles")) {
      const Eigen::MatrixXd labels = read_dmat(file(given_["inputs"]["handles"]));
      for (const double label : labels.reshaped()) handles.emplace_back(static_cast<std::int32_t>(label));
    }
    root_bone = given_["root_bone"].get<std::size_t>();
  }

  nlohmann::json read_json(const std::string& file) const {
    std::ifstream stream(shared_file("assignment6/reference/" + name_ + "/" + file));
    return nlohmann::json::parse(stream);
  }
  static InputFile file(const std::string& name) {
    return read_input_file(shared_file("assignment6/" + name));
  }
  const nlohmann::json& given() const { return given_; }

  /// Rotations of all bones in a reference file.
  static std::vector<Quat> quats(const nlohmann::json& list) {
    std::vector<Quat> all;
    for (const auto& q : list)
      all.push_back(
          quaternion_xyzw(q[0].get<double>(), q[1].get<double>(), q[2].get<double>(), q[3].get<double>()));
    return all;
  }
  static Vec3 vec3(const nlohmann::json& j) {
    return {j[0].get<double>(), j[1].get<double>(), j[2].get<double>()};
  }

  /// Largest distance between the sampled vertices of `positions` and the list under `key`.
  double distance(const std::vector<Vec3>& positions, const nlohmann::json& reference,
                  const char* key) const {
    double largest = 0;
    const auto& ids = reference.contains("vertex_ids") ? reference["vertex_ids"] : given_["vertex_ids"];
    for (std::size_t i = 0; i < ids.size(); ++i)
      largest = std::max(largest, (positions[ids[i].get<std::size_t>()] - vec3(reference[key][i])).norm());
    return largest;
  }

  /// Largest difference of the centroid and bounding box of all `positions` from those under full/`key`.
  static double full_distance(const std::vector<Vec3>& positions, const nlohmann::json& reference,
                              const char* key) {
    Eigen::AlignedBox3d box;
    Vec3 sum = Vec3::Zero();
    for (const Vec3& p : positions) {
      box.extend(p);
      sum += p;
    }
    const auto& full = reference["full"][key];
    return std::max({(sum / static_cast<double>(positions.size()) - vec3(full["centroid"])).norm(),
                     (box.min() - vec3(full["bbox_min"])).norm(),
                     (box.max() - vec3(full["bbox_max"])).norm()});
  }

  /// The vertices that the first root bone holds.
  std::vector<VertexId> root_handle() const {
    std::vector<VertexId> held;
    for (std::size_t v = 0; v < handles.size(); ++v)
      if (handles[v] == JointId(root_bone)) held.emplace_back(v);
    return held;
  }

  PolygonMesh mesh;
  VertexTriangles triangles;
  BoneForest forest;
  RotationFrames frames;
  std::vector<JointId> handles;  ///< by bone, invalid = free
  std::size_t root_bone = 0;

 private:
  std::string name_;
  nlohmann::json given_;
};

inline std::vector<Quat> rotations_of(const std::vector<RigidMotion>& motions) {
  std::vector<Quat> all;
  for (const RigidMotion& m : motions) all.push_back(m.rotation);
  return all;
}

inline std::vector<Affine3> matrices_of(const std::vector<RigidMotion>& motions) {
  std::vector<Affine3> all;
  for (const RigidMotion& m : motions) all.push_back(m.matrix());
  return all;
}

}  // namespace skinforge::testing
