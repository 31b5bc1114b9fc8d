#include "surface/loose_parts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "surface/shapes.h"

namespace skinforge {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr int kAround = 8;

// root -> body -> leg -> shin, and root -> ik -> toe, as riggers do it for feet.
Skeleton rig() {
  Skeleton skeleton;
  const auto add = [&](const char* name, int parent) {
    Joint joint;
    joint.name = name;
    if (parent >= 0) joint.parent = JointId(parent);
    skeleton.joints.push_back(joint);
  };
  add("root", -1), add("body", 0), add("leg", 1), add("shin", 2), add("ik", 0), add("toe", 4);
  return skeleton;
}
constexpr int kBody = 1, kLeg = 2, kShin = 3, kIk = 4, kToe = 5;

// Tubes, ring by ring on one joint each.
struct Scene {
  PolygonMesh mesh;
  SkinWeights weights;
  Skeleton skeleton = rig();

  void add(const std::vector<int>& joints, double first, double radius = 1) {
    const PolygonMesh tube = testing::open_tube(static_cast<int>(joints.size()), kAround, first, 1, radius);
    mesh = mesh.vertex_count() == 0 ? tube : testing::joined(mesh, tube);
    for (const int joint : joints)
      for (int a = 0; a < kAround; ++a) weights.push_row(std::vector<Influence>{{JointId(joint), 1}});
  }
  // Faces without a vertex on the leg or below it; or the others.
  FaceSet side(bool of_body) const {
    const std::vector<bool> leg = skeleton.subtree(JointId(kLeg));
    FaceSet faces;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
      const auto face = mesh.face(FaceId(f));
      const bool is_body = std::none_of(face.begin(), face.end(),
                                        [&](VertexId v) { return leg[weights.of(v)[0].joint.index()]; });
      faces.push_back(is_body == of_body);
    }
    return faces;
  }
  std::vector<LoosePart> find(bool of_body = true) const {
    return loose_parts(mesh, weights, skeleton, side(of_body), std::vector<JointId>{JointId(kLeg)});
  }
};

// A hoof on an IK joint beside the leg: two belts of faces stay in the air, and the topmost joint is named.
TEST(LooseParts, AHoofOnAnIkJoint) {
  Scene scene;
  scene.add({kBody, kBody, kBody, kBody, kLeg, kLeg, kShin, kIk, kIk, kToe}, 0);
  const auto parts = scene.find();
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_EQ(parts[0].faces, 2u * kAround);
  EXPECT_THAT(parts[0].joints, ElementsAre(JointId(kIk)));
}

TEST(LooseParts, NothingWhereTheHoofHangsOnTheLeg) {
  Scene scene;
  scene.add({kBody, kBody, kBody, kBody, kLeg, kLeg, kShin, kShin, kShin}, 0);
  EXPECT_THAT(scene.find(), IsEmpty());
}

// A shoe of its own round the end of the leg.
TEST(LooseParts, AShoeOnAnIkJoint) {
  Scene scene;
  scene.add({kBody, kBody, kBody, kBody, kBody, kBody, kLeg, kLeg, kShin, kShin, kShin, kShin}, 0);
  scene.add({kIk, kIk, kIk}, 9, 1.1);
  const auto parts = scene.find();
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_EQ(parts[0].faces, 2u * kAround);
  EXPECT_THAT(parts[0].joints, ElementsAre(JointId(kIk)));
}

// A skirt of the body's joint over the leg is the body's, and a belt of the IK joint round the body lies on
// it.
TEST(LooseParts, WhatTheBodyHoldsStays) {
  Scene scene;
  scene.add({kBody, kBody, kBody, kBody, kBody, kBody, kLeg, kLeg, kShin, kShin, kShin, kShin}, 0);
  scene.add({kBody, kBody, kBody}, 8, 1.3);
  scene.add({kIk, kIk, kIk}, 1, 1.1);
  EXPECT_THAT(scene.find(), IsEmpty());
}

// Without a cut nothing is loose.
TEST(LooseParts, OnePartAlone) {
  Scene scene;
  scene.add({kBody, kBody, kBody}, 0);
  EXPECT_THAT(scene.find(), IsEmpty());
}

}  // namespace
}  // namespace skinforge
