#include <gtest/gtest.h>

#include <numeric>

#include "deform/example_weights.h"
#include "deform/face_context.h"
#include "deform/unposing.h"
#include "skinning/harmonic_weights.h"
#include "skinning/linear_blend.h"
#include "testing/course.h"

namespace skinforge {
namespace {

using testing::CourseCase;

constexpr double kClosedForm = 1e-9, kSolved = 1e-8;  // of the reference's own page

/// The human with its four examples, made once: it takes a second.
struct Human {
  CourseCase course{"human"};
  SkinWeights weights = harmonic_weights(course.mesh.positions, course.triangles, course.handles).weights;
  std::vector<VertexId> held = course.root_handle();
  PoissonStitcher stitcher{course.mesh.positions, course.triangles, held};
  FaceBlend blend{course.triangles, weights};
  std::vector<std::vector<Vec3>> shapes;
  std::vector<std::vector<Quat>> local, bones;
  std::vector<std::vector<Affine3>> palettes;
  std::vector<Eigen::VectorXd> points;
  std::vector<std::size_t> all_bones;

  Human() : all_bones(course.forest.size()) {
    std::iota(all_bones.begin(), all_bones.end(), 0);
    for (const char* name : {"eg0", "eg1", "eg2", "eg3"}) {
      const std::string path = std::string("context-aware/") + name;
      shapes.push_back(read_plain_mesh(CourseCase::file(path + ".obj")).positions);
      local.push_back(
          rotation_frames(read_dmat(CourseCase::file(path + ".dmat")), course.forest.size()).frames[0]);
      const auto motions = forward_kinematics(course.forest, local.back());
      bones.push_back(testing::rotations_of(motions));
      palettes.push_back(testing::matrices_of(motions));
      points.push_back(pose_point(local.back(), all_bones));
    }
  }
  static const Human& get() {
    static const Human human;
    return human;
  }
  std::vector<RigidMotion> motions(std::size_t frame) const {
    return forward_kinematics(course.forest, course.frames.frames[frame]);
  }
  std::vector<Vec3> offset_rest(const std::vector<double>& a) const {
    std::vector<Vec3> rest = course.mesh.positions;
    for (std::size_t j = 0; j < a.size(); ++j) {
      const Unposed unposed = unpose(course.mesh.positions, shapes[j], weights, palettes[j]);
      for (std::size_t v = 0; v < rest.size(); ++v) rest[v] += a[j] * unposed.offsets[v];
    }
    return rest;
  }
};

double largest_distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double largest = 0;
  for (std::size_t v = 0; v < a.size(); ++v) largest = std::max(largest, (a[v] - b[v]).norm());
  return largest;
}

TEST(CourseContext, ExampleWeightsAgree) {
  SKINFORGE_NEEDS_SHARED();
  const Human& human = Human::get();
  const auto reference = human.course.read_json("example_weights.json");
  const std::pair<RadialKernel, const char*> kernels[] = {
      {RadialKernel::Linear, "rotation_matrices/linear"},
      {RadialKernel::Gaussian, "rotation_matrices/gauss"}};
  for (const auto& [kernel, name] : kernels) {
    const ExampleWeights weights(human.points, kernel);
    for (std::size_t i = 0; i < reference["frames"].size(); ++i) {
      const auto frame = reference["frames"][i].get<std::size_t>();
      const Eigen::VectorXd point = pose_point(human.course.frames.frames[frame], human.all_bones);
      const Eigen::VectorXd raw = weights.raw(point);
      for (std::size_t j = 0; j < 4; ++j)
        EXPECT_NEAR(raw[static_cast<Eigen::Index>(j)], reference[name]["raw"][i][j].get<double>(),
                    kClosedForm);
      if (weights.is_far(point)) continue;  // guarded: not the plain Eq. 8
      for (std::size_t j = 0; j < 4; ++j)
        EXPECT_NEAR(weights(point)[j], reference[name]["normalised"][i][j].get<double>(), kClosedForm);
    }
  }
}

TEST(CourseContext, OffsetsAgree) {
  SKINFORGE_NEEDS_SHARED();
  const Human& human = Human::get();
  const auto reference = human.course.read_json("examples.json");
  for (std::size_t j = 0; j < 4; ++j) {
    const Unposed unposed =
        unpose(human.course.mesh.positions, human.shapes[j], human.weights, human.palettes[j]);
    for (std::size_t i = 0; i < reference["vertex_ids"].size(); ++i)
      EXPECT_LT((unposed.offsets[reference["vertex_ids"][i].get<std::size_t>()] -
                 CourseCase::vec3(reference["delta"][j][i]))
                    .norm(),
                kClosedForm);
    EXPECT_TRUE(unposed.damped.empty());
    EXPECT_LT(unposed.worst_condition, 4);
  }
}

class CourseContextFrame : public ::testing::TestWithParam<std::size_t> {};

TEST_P(CourseContextFrame, VertexAndFaceContextAgree) {
  SKINFORGE_NEEDS_SHARED();
  const Human& human = Human::get();
  const std::size_t frame = GetParam();
  const auto reference = human.course.read_json("f" + std::to_string(frame) + ".json");
  const auto a = ExampleWeights(human.points)(pose_point(human.course.frames.frames[frame], human.all_bones));
  for (std::size_t j = 0; j < 4; ++j) EXPECT_NEAR(a[j], reference["a_linear"][j].get<double>(), kClosedForm);
  const auto motions = human.motions(frame);
  const auto by_vertex = linear_blend(human.offset_rest(a), human.weights, testing::matrices_of(motions));
  EXPECT_LT(human.course.distance(by_vertex, reference, "ctx_vertex"), kClosedForm);
  const FaceContext context(human.stitcher, human.blend, human.course.mesh.positions, human.course.triangles,
                            human.shapes, human.bones, FaceContext::Form::Stitched);
  const auto rotations = human.blend.rotations(testing::rotations_of(motions));
  std::vector<Vec3> places = human.course.mesh.positions;
  for (const VertexId v : human.held) places[v.index()] = motions[human.course.root_bone] * places[v.index()];
  const auto eq9 = human.stitcher.stitch(context.maps(rotations, a, FaceContextKind::Linear), places);
  EXPECT_LT(human.course.distance(eq9, reference, "ctx_face_eq9"), kSolved);
  const auto eq10 = human.stitcher.stitch(context.maps(rotations, a, FaceContextKind::Polar), places);
  EXPECT_LT(human.course.distance(eq10, reference, "ctx_face_eq10"), kSolved);
  EXPECT_LT(CourseCase::full_distance(eq10, reference, "ctx_face_eq10"), kSolved);
}

INSTANTIATE_TEST_SUITE_P(Human, CourseContextFrame, ::testing::Values(10, 34, 60, 80));

// Frame 34 is example 0 and frame 80 example 3.
TEST(CourseContext, ExamplesComeBack) {
  SKINFORGE_NEEDS_SHARED();
  const Human& human = Human::get();
  const ExampleWeights weights(human.points);
  const FaceContext context(human.stitcher, human.blend, human.course.mesh.positions, human.course.triangles,
                            human.shapes, human.bones);
  for (std::size_t j = 0; j < 4; ++j) {
    const auto a = weights(human.points[j]);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(a[i], i == j ? 1 : 0, 1e-12);
    EXPECT_LT(largest_distance(linear_blend(human.offset_rest(a), human.weights, human.palettes[j]),
                               human.shapes[j]),
              1e-12);
    for (const FaceContextKind kind : {FaceContextKind::Linear, FaceContextKind::Polar}) {
      const auto maps = context.maps(human.blend.rotations(human.bones[j]), a, kind);
      EXPECT_LT(largest_distance(human.stitcher.stitch(maps, human.shapes[j]), human.shapes[j]), 1e-11);
    }
  }
}

}  // namespace
}  // namespace skinforge
