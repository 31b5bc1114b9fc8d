#include "skinning/handles.h"

#include <gmock/gmock.h>

#include "base/error.h"
#include "model/material.h"
#include "testing/course.h"
#include "testing/shapes.h"

namespace skinforge {
namespace {

using ::testing::ElementsAre;

const JointId kFree;

// Points over the segments 0 (x from 0 to 1) and 1 (x from 1 to 2): distances to the own segment are the
// heights 1, 1.4, 1.6, 2 and 0.1 at the far end.
TEST(HandlesByDistance, TheSheetsRule) {
  const std::vector<BoneSegment> bones{{JointId(0), {0, 0, 0}, {1, 0, 0}},
                                       {JointId(1), {1, 0, 0}, {2, 0, 0}}};
  const std::vector<Vec3> points{{0.5, 1, 0}, {0.4, 1.4, 0}, {0.3, 1.6, 0}, {1.5, 2, 0}, {2.1, 0, 0}};
  EXPECT_THAT(handles_by_distance(points, bones, {.factor = 1.5, .at_least = 0}),
              ElementsAre(JointId(0), JointId(0), kFree, kFree, JointId(1)));
  // Wanting two, joint 1 takes the next nearest vertex that is nearer to it than to joint 0.
  EXPECT_THAT(handles_by_distance(points, bones, {.factor = 1.5, .at_least = 2}),
              ElementsAre(JointId(0), JointId(0), kFree, JointId(1), JointId(1)));
}

TEST(BoneSegments, ZeroLengthIsAPoint) {
  const BoneSegment point{JointId(0), {1, 2, 3}, {1, 2, 3}};
  EXPECT_EQ(point.closest({5, 5, 5}), Vec3(1, 2, 3));
}

// The rule of the sheet on every vertex, by a program that is not ours.
TEST(HandlesByDistance, AgreesWithTheCourseReference) {
  SKINFORGE_NEEDS_SHARED();
  const std::pair<const char*, const char*> cases[] = {
      {"hand_sequence", "hand"}, {"human", "human"}, {"cylinder_target", "cylinder"}};
  for (const auto& [name, rule] : cases) {
    const testing::CourseCase course(name);
    std::vector<BoneSegment> bones;
    for (std::size_t k = 0; k < course.forest.size(); ++k)
      bones.push_back({JointId(k), course.forest.source[k], course.forest.end[k]});
    const Handles handles = handles_by_distance(course.mesh.positions, bones, {.factor = 1.5, .at_least = 0});
    const auto expected =
        read_dmat(testing::CourseCase::file(std::string("reference/handles_rule_1p5_") + rule + ".dmat"));
    EXPECT_EQ(label_table(handles), expected) << rule;
  }
}

TEST(HandlesOfWeights, DominantJointAboveTheThreshold) {
  SkinWeights weights;
  weights.push_row(std::vector<Influence>{{JointId(2), 0.7}, {JointId(0), 0.3}});
  weights.push_row(std::vector<Influence>{{JointId(1), 0.6}, {JointId(0), 0.4}});
  EXPECT_THAT(handles_of_weights(weights), ElementsAre(JointId(2), kFree));
}

TEST(HandlesOfLabels, ChecksEveryLabel) {
  const std::vector<JointId> bones{JointId(3), JointId(1)};
  EXPECT_THAT(handles_of_labels(Eigen::Vector3d(1, -1, 0), 3, bones),
              ElementsAre(JointId(1), kFree, JointId(3)));
  const auto refusal = [&](const Eigen::MatrixXd& table) {
    try {
      handles_of_labels(table, 2, bones);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("nothing was refused");
  };
  EXPECT_EQ(refusal(Eigen::Vector2d(0, 2)),
            "label 2 of vertex 1: labels are -1 (free) or a bone from 0 to 1");
  EXPECT_EQ(refusal(Eigen::Vector2d(0.5, 0)),
            "label 0.5 of vertex 0: labels are -1 (free) or a bone from 0 to 1");
  EXPECT_EQ(refusal(Eigen::Vector3d(0, 0, 0)), "3 x 1 labels; the mesh has 2 vertices, each with one label");
}

// Two triangles over one edge in two groups: the shared vertices belong to neither.
TEST(HandlesOfGroups, VerticesInsideAGroup) {
  PolygonMesh mesh =
      testing::polygon_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 3, 2}});
  mesh.parts = {{.name = "arm"}, {.name = "other"}};
  mesh.face_part = {PartId(0), PartId(1)};
  Skeleton skeleton;
  skeleton.joints.resize(1);
  skeleton.joints[0].name = "arm";
  EXPECT_THAT(handles_of_groups(mesh, skeleton), ElementsAre(JointId(0), kFree, kFree, kFree));
  mesh.parts[0].name = "leg";
  EXPECT_THROW(handles_of_groups(mesh, skeleton), Error);
}

TEST(HandlesOfImage, LooksUpThePixelUnderEachCorner) {
  PolygonMesh mesh = testing::polygon_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  mesh.uvs = {{{0.1, 0.1}, {0.9, 0.1}, {0.1, 0.9}}};
  const Raster image{2, 2, {255, 0, 0, 255, 0, 255, 0, 255, 250, 3, 0, 255, 9, 9, 9, 255}};
  const std::vector<LabelColor> labels{{{255, 0, 0}, JointId(4)}};
  EXPECT_THAT(handles_of_image(mesh, labels, image), ElementsAre(JointId(4), kFree, JointId(4)));
}

}  // namespace
}  // namespace skinforge
