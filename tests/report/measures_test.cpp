#include "report/measures.h"

#include <gmock/gmock.h>

#include "model/character.h"

namespace skinforge {
namespace {

using ::testing::ElementsAre;

// A quad and a triangle over five points.
PolygonMesh quad_and_triangle() {
  PolygonMesh mesh;
  mesh.positions = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 2, 0), Vec3(0, 2, 0), Vec3(1, 0, -3)};
  for (const int v : {0, 1, 2, 3, 1, 4, 2}) mesh.corners.emplace_back(v);
  mesh.face_begin = {0, 4, 7};
  return mesh;
}

TEST(Measures, MeshByHand) {
  const MeshReport report = measure_mesh(quad_and_triangle(), 1);
  EXPECT_EQ(report.vertices, 5);
  EXPECT_EQ(report.faces, 2);
  EXPECT_EQ(report.quads, 1);
  EXPECT_EQ(report.triangles, 1);
  EXPECT_EQ(report.kept_share, 0.5);
  EXPECT_THAT(report.bind_size, ElementsAre(1, 2, 3));
}

TEST(Measures, EmptyMesh) {
  const MeshReport report = measure_mesh(PolygonMesh{}, 0);
  EXPECT_EQ(report.faces, 0);
  EXPECT_EQ(report.kept_share, 0);
  EXPECT_THAT(report.bind_size, ElementsAre(0, 0, 0));
}

TEST(Measures, WeightsByHand) {
  Skeleton skeleton;
  for (const char* name : {"Root", "Arm", "Helper"}) {
    skeleton.joints.emplace_back();
    skeleton.joints.back().name = name;
  }
  SkinWeights weights;
  const std::vector<Influence> two{{JointId(0), 0.5}, {JointId(1), 0.25}}, one{{JointId(1), 1}};
  weights.push_row(two);
  weights.push_row(one);
  weights.push_row({});
  const WeightsReport report = measure_weights(weights, skeleton, 4);
  EXPECT_EQ(report.max_influences, 2);
  EXPECT_EQ(report.row_sum_min, 0);
  EXPECT_EQ(report.row_sum_max, 1);
  EXPECT_EQ(report.unweighted_vertices, 1);
  EXPECT_THAT(report.joints_without_weight, ElementsAre("Helper"));
}

TEST(Measures, WeightsThatAreCutByHand) {
  Skeleton skeleton;
  skeleton.joints.resize(3);
  SkinWeights weights;
  const std::vector<Influence> three{{JointId(0), 0.125}, {JointId(1), 0.625}, {JointId(2), 0.25}};
  weights.push_row(three);
  const WeightsReport report = measure_weights(weights, skeleton, 2);
  EXPECT_EQ(report.max_influences, 2);
  EXPECT_EQ(report.cut_vertices, 1);
  EXPECT_EQ(report.cut_weight_max, 0.125);
  EXPECT_NEAR(report.row_sum_max, 1, 1e-15);
}

TEST(Measures, KeysOfAllTracks) {
  Clip clip;
  clip.joints.resize(2);
  clip.joints[0].translation.times = {0, 1};
  clip.joints[1].rotation.times = {0, 0.5, 1};
  clip.morphs.resize(1);
  clip.morphs[0].weights.times = {0};
  EXPECT_EQ(count_keys(clip), 6);
}

TEST(Measures, InputCounts) {
  Character c;
  c.mesh = quad_and_triangle();
  c.clips.resize(3);
  c.morphs.resize(2);
  const InputReport report = measure_input(c);
  EXPECT_EQ(report.quads, 1);
  EXPECT_EQ(report.clips, 3);
  EXPECT_EQ(report.morph_targets, 2);
}

TEST(Measures, PlacementIsWrittenXyzw) {
  OperationReport operation;
  set_placement(operation, {2, quaternion_xyzw(0.6, 0, 0, 0.8), Vec3(1, 2, 3)});
  EXPECT_EQ(operation.scale, 2);
  EXPECT_THAT(operation.rotation_xyzw, ElementsAre(0.6, 0, 0, 0.8));
  EXPECT_THAT(operation.translation, ElementsAre(1, 2, 3));
}

}  // namespace
}  // namespace skinforge
