#include <gmock/gmock.h>

#include "deform/dual_quaternion_blend.h"
#include "deform/face_rotations.h"
#include "deform/poisson_stitch.h"
#include "skinning/harmonic_weights.h"
#include "skinning/linear_blend.h"
#include "testing/course.h"

namespace skinforge {
namespace {

using testing::CourseCase;

// Tolerances of the reference's own page; characters are about 2 across.
constexpr double kClosedForm = 1e-9, kSolved = 1e-8;

struct Frame {
  const char* name;
  const char* file;
};

class CourseReference : public ::testing::TestWithParam<Frame> {
 protected:
  void SetUp() override { SKINFORGE_NEEDS_SHARED(); }
};

SkinWeights given_weights(const CourseCase& course) {
  const Eigen::MatrixXd table = read_dmat(CourseCase::file(course.given()["inputs"]["weights"]));
  SkinWeights weights;
  std::vector<Influence> row;
  for (Eigen::Index v = 0; v < table.rows(); ++v) {
    row.clear();
    for (Eigen::Index k = 0; k < table.cols(); ++k)
      row.push_back({JointId(static_cast<std::int32_t>(k)), table(v, k)});
    weights.push_row(row);
  }
  return weights;
}

SkinWeights weights_of(const CourseCase& course) {
  if (course.handles.empty()) return given_weights(course);
  return harmonic_weights(course.mesh.positions, course.triangles, course.handles).weights;
}

std::vector<Quat> local_pose(const CourseCase& course, const nlohmann::json& frame) {
  const double at = frame["frame"].get<double>();
  if (frame["frame_kind"].get<std::string>().starts_with("slerp"))
    return pose_towards(course.frames.frames.front(), at);
  return course.frames.frames.at(static_cast<std::size_t>(at));
}

double angle_free_distance(const Quat& a, const Quat& b) {
  return (a.toRotationMatrix() - b.toRotationMatrix()).norm();
}

TEST_P(CourseReference, ForwardKinematics) {
  const CourseCase course(GetParam().name);
  const auto frame = course.read_json(GetParam().file);
  const auto motions = forward_kinematics(course.forest, local_pose(course, frame));
  const auto quats = CourseCase::quats(frame["bone_quat_xyzw"]);
  const auto pairs = course.given()["bone_joint_pairs_0based"];
  for (std::size_t k = 0; k < motions.size(); ++k) {
    EXPECT_EQ(course.forest.parent[k], course.given()["bone_parent"][k].get<int>());
    EXPECT_LT(angle_free_distance(motions[k].rotation, quats[k]), kClosedForm);
    EXPECT_LT((motions[k].translation - CourseCase::vec3(frame["bone_translation"][k])).norm(), kClosedForm);
    const Vec3 joint = CourseCase::vec3(frame["joint_positions"][pairs[k][1].get<std::size_t>()]);
    EXPECT_LT((motions[k] * course.forest.end[k] - joint).norm(), kClosedForm);
  }
  EXPECT_EQ(course.forest.roots.front(), static_cast<int>(course.root_bone));
}

TEST_P(CourseReference, Weights) {
  const CourseCase course(GetParam().name);
  const SkinWeights weights = weights_of(course);
  const auto& given = course.given();
  for (std::size_t i = 0; i < given["vertex_ids"].size(); ++i) {
    std::vector<double> row(course.forest.size(), 0.0);
    for (const Influence& w : weights.of(VertexId(given["vertex_ids"][i].get<std::size_t>())))
      row[w.joint.index()] += w.weight;
    for (std::size_t k = 0; k < row.size(); ++k)
      EXPECT_NEAR(row[k], given["weights"][i][k].get<double>(), kClosedForm);
  }
  std::vector<double> sums(course.forest.size(), 0.0);
  for (const Influence& w : weights.influences) sums[w.joint.index()] += w.weight;
  for (std::size_t k = 0; k < sums.size(); ++k)  // sums over up to 20000 vertices
    EXPECT_NEAR(sums[k], given["weights_full"]["column_sums"][k].get<double>(), 1e-8);
}

TEST_P(CourseReference, LinearAndDualQuaternionBlending) {
  const CourseCase course(GetParam().name);
  const auto frame = course.read_json(GetParam().file);
  const SkinWeights weights = weights_of(course);
  const auto motions = forward_kinematics(course.forest, local_pose(course, frame));
  const auto linear = linear_blend(course.mesh.positions, weights, testing::matrices_of(motions));
  EXPECT_LT(course.distance(linear, frame, "lbs"), kClosedForm);
  EXPECT_LT(CourseCase::full_distance(linear, frame, "lbs"), kClosedForm);
  const auto dual = dual_quaternion_blend(course.mesh.positions, weights, motions);
  EXPECT_LT(course.distance(dual, frame, "dqs"), kClosedForm);
  EXPECT_LT(CourseCase::full_distance(dual, frame, "dqs"), kClosedForm);
}

TEST_P(CourseReference, FaceRotationsAndPoissonStitching) {
  const CourseCase course(GetParam().name);
  const auto frame = course.read_json(GetParam().file);
  const SkinWeights weights = weights_of(course);
  const auto motions = forward_kinematics(course.forest, local_pose(course, frame));
  const FaceBlend blend(course.triangles, weights);
  const auto rotations = blend.rotations(testing::rotations_of(motions));
  if (!frame.contains("poisson")) return;  // the arm has neither
  const auto quats = CourseCase::quats(frame["face_quat_xyzw"]);
  for (std::size_t i = 0; i < quats.size(); ++i)
    EXPECT_LT(angle_free_distance(rotations[frame["face_ids"][i].get<std::size_t>()], quats[i]), kClosedForm);
  const auto held = course.root_handle();
  const PoissonStitcher stitcher(course.mesh.positions, course.triangles, held);
  std::vector<Mat3> maps;
  for (const Quat& q : rotations) maps.push_back(q.toRotationMatrix());
  std::vector<Vec3> places = course.mesh.positions;
  for (const VertexId v : held) places[v.index()] = motions[course.root_bone] * places[v.index()];
  const auto stitched = stitcher.stitch(maps, places);
  EXPECT_LT(course.distance(stitched, frame, "poisson"), kSolved);
  EXPECT_LT(CourseCase::full_distance(stitched, frame, "poisson"), kSolved);
  if (!frame.contains("poisson_root_at_rest")) return;
  EXPECT_LT(course.distance(stitcher.stitch(maps, course.mesh.positions), frame, "poisson_root_at_rest"),
            kSolved);
}

INSTANTIATE_TEST_SUITE_P(
    Course, CourseReference,
    ::testing::Values(Frame{"hand_sequence", "f0.json"}, Frame{"hand_sequence", "f5.json"},
                      Frame{"hand_sequence", "f16.json"}, Frame{"hand_sequence", "f33.json"},
                      Frame{"hand_target", "t0.25.json"}, Frame{"hand_target", "t0.5.json"},
                      Frame{"hand_target", "t1.json"}, Frame{"cylinder_target", "t0.25.json"},
                      Frame{"cylinder_target", "t0.5.json"}, Frame{"cylinder_target", "t1.json"},
                      Frame{"human", "f10.json"}, Frame{"human", "f34.json"}, Frame{"human", "f60.json"},
                      Frame{"human", "f80.json"}, Frame{"arm", "f1.json"}, Frame{"arm", "f2.json"},
                      Frame{"arm", "f4.json"}),
    [](const auto& one) {
      std::string name = std::string(one.param.name) + "_" + one.param.file;
      name.erase(name.rfind(".json"));
      std::replace(name.begin(), name.end(), '.', '_');
      return name;
    });

}  // namespace
}  // namespace skinforge
