#include "skeleton/bone_forest.h"

#include <gmock/gmock.h>

#include "base/error.h"
#include "skeleton/bone_rig.h"
#include "skeleton/pose.h"

namespace skinforge {
namespace {

constexpr double kRounding = 1e-14;  // a handful of products of numbers near 1

// An arm along x in two bones, given backwards, and a second tree: a root bone along y.
BoneGraph two_trees() {
  return {{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {5, 0, 0}, {5, 1, 0}}, {{{1, 2}}, {{0, 1}}, {{3, 4}}}};
}

Quat quarter_turn_z() {
  return Quat(Eigen::AngleAxisd(radians(90), Vec3::UnitZ()));
}

TEST(BoneForest, ParentsInAnyOrderAndSeveralRoots) {
  const BoneForest forest = make_bone_forest(two_trees());
  EXPECT_THAT(forest.parent, ::testing::ElementsAre(1, -1, -1));
  EXPECT_THAT(forest.roots, ::testing::ElementsAre(1, 2));
  EXPECT_THAT(forest.order, ::testing::ElementsAre(1, 2, 0));
}

std::string refusal(BoneGraph graph) {
  try {
    make_bone_forest(graph);
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing was refused";
}

TEST(BoneForest, RefusesCyclesAndTwoParents) {
  BoneGraph two_parents = two_trees();
  two_parents.bones.push_back({3, 2});
  EXPECT_EQ(refusal(two_parents), "joint 3 has two parents: bones 1 and 4 end there");
  BoneGraph cycle = two_trees();
  cycle.bones = {{{0, 1}}, {{2, 3}}, {{3, 4}}, {{4, 2}}};
  EXPECT_EQ(refusal(cycle),
            "bones form a cycle: bone 2 (joint 3 to 4) hangs under itself or under such a bone");
}

// Both bones of the arm turn by 90 degrees about z: the elbow goes to (0, 1, 0), the hand to (-1, 1, 0).
TEST(ForwardKinematics, ArmByHand) {
  const BoneForest forest = make_bone_forest(two_trees());
  const std::vector<Quat> pose{quarter_turn_z(), quarter_turn_z(), Quat::Identity()};
  const auto motion = forward_kinematics(forest, pose);
  EXPECT_LT((motion[1] * Vec3(1, 0, 0) - Vec3(0, 1, 0)).norm(), kRounding);
  EXPECT_LT((motion[0] * Vec3(1, 0, 0) - Vec3(0, 1, 0)).norm(), kRounding);
  EXPECT_LT((motion[0] * Vec3(2, 0, 0) - Vec3(-1, 1, 0)).norm(), kRounding);
  EXPECT_EQ(motion[2] * Vec3(5, 1, 0), Vec3(5, 1, 0));
}

// 190 degrees about -x, as in the cylinder's target: half way lies 85 degrees about x.
TEST(PoseTowards, TakesTheShorterArc) {
  const std::vector<Quat> target{Quat(Eigen::AngleAxisd(radians(190), -Vec3::UnitX()))};
  const Quat half = pose_towards(target, 0.5)[0];
  EXPECT_LT((half * Vec3::UnitY() - Vec3(0, std::cos(radians(85)), std::sin(radians(85)))).norm(), kRounding);
}

// The palette of the rig at a key is the forward kinematics of the frame.
TEST(BoneRig, PlaysFramesAsForwardKinematicsDoes) {
  const BoneForest forest = make_bone_forest(two_trees());
  const BoneRig rig = make_bone_rig(forest);
  EXPECT_THAT(rig.skeleton.names(),
              ::testing::ElementsAre("root", "bone1", "bone2", "bone0", "bone0_end", "bone2_end"));
  RotationFrames frames;
  frames.frames = {{Quat::Identity(), Quat::Identity(), Quat::Identity()},
                   {quarter_turn_z(), Quat(Eigen::AngleAxisd(1, Vec3(1, 2, 2) / 3)), quarter_turn_z()}};
  const Clip clip = clip_of_frames(rig, frames, "pose", 30);
  EXPECT_DOUBLE_EQ(clip.duration, 1.0 / 30);
  Pose pose = bind_pose(rig.skeleton);
  for (const JointTracks& tracks : clip.joints)
    pose[tracks.joint.index()].rotation = tracks.rotation.values[1];
  const auto palette = skinning_palette(rig.skeleton, pose);
  const auto motion = forward_kinematics(forest, frames.frames[1]);
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_LT((palette[rig.joint_of_bone[k].index()].matrix() - motion[k].matrix().matrix()).norm(),
              kRounding);
}

// The same bones with joints that carry bind rotations of their own, as those of a model do: frames are in
// model axes of the bind pose, so they mean the same.
TEST(BoneRig, AxesOfJointsDoNotMatter) {
  const BoneForest forest = make_bone_forest(two_trees());
  BoneRig rig = make_bone_rig(forest);
  Quat above = Quat::Identity();
  for (Joint& joint : rig.skeleton.joints) {
    Affine3 model_from_joint = joint.joint_from_model.inverse();
    above = above * Quat(Eigen::AngleAxisd(0.7, Vec3(2, -1, 2) / 3));
    model_from_joint.linear() = above.toRotationMatrix();
    joint.joint_from_model = model_from_joint.inverse();
    const Affine3 parent =
        joint.parent.is_valid() ? rig.skeleton[joint.parent].joint_from_model : Affine3::Identity();
    const Affine3 local = parent * model_from_joint;
    joint.bind.translation = local.translation();
    joint.bind.rotation = Quat(local.rotation());
  }
  const std::vector<Quat> frame{quarter_turn_z(), Quat(Eigen::AngleAxisd(1, Vec3(1, 2, 2) / 3)),
                                quarter_turn_z()};
  Pose pose = bind_pose(rig.skeleton);
  const std::vector<Quat> local = local_rotations(rig, frame);
  for (std::size_t j = 0; j < pose.size(); ++j) pose[j].rotation = local[j];
  const auto palette = skinning_palette(rig.skeleton, pose);
  const auto motion = forward_kinematics(forest, frame);
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_LT((palette[rig.joint_of_bone[k].index()].matrix() - motion[k].matrix().matrix()).norm(), 1e-12);
}

}  // namespace
}  // namespace skinforge
