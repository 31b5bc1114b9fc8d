#include "skeleton/pose.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "skeletons.h"

namespace skinforge {
namespace {
using namespace testing;
constexpr double kRounding = 1e-12;  // a few hundred products of numbers near 1

const Quat kQuarterZ(Eigen::AngleAxisd(radians(90), Vec3::UnitZ()));

// By hand: b stands at (2,0,0) in a; turning a by 90 degrees about z puts it at a + (0,1,0).
TEST(Pose, ForwardKinematicsByHand) {
  const Skeleton chain = straight_chain(3);
  Pose pose = bind_pose(chain);
  pose[1].rotation = kQuarterZ;
  EXPECT_THAT(Vec3(model_from_joint(chain, pose)[2].translation()), IsNearVec(Vec3(1, 1, 0), kRounding));
}

TEST(Pose, BindPoseInvertsTheInverseBindMatrices) {
  const Skeleton s = random_skeleton(40, 1);
  for (const Affine3& m : skinning_palette(s, bind_pose(s)))
    EXPECT_LT(difference(m, Affine3::Identity()), kRounding * 1e3);
}

// Law: scale on ancestors changes no rotation.
TEST(Pose, GlobalRotationsIgnoreScale) {
  const Skeleton s = random_skeleton(40, 2);
  const auto rotations = global_rotations(s, bind_pose(s));
  const auto placed = model_from_joint(s, bind_pose(s));
  for (std::size_t j = 0; j < s.size(); ++j) {
    const Mat3 unscaled = placed[j].linear() / std::cbrt(placed[j].linear().determinant());
    EXPECT_LT((unscaled - rotations[j].toRotationMatrix()).norm(), kRounding * 1e3);
  }
}

TEST(Pose, WrongSizeIsABug) {
  EXPECT_THROW(model_from_joint(straight_chain(2), Pose(1)), Error);
}

// By hand: on a chain of four with 0 at one end and 3 at the other the harmonic values are 1 and 2.
TEST(SpreadTranslations, ChainBetweenTwoGivenJoints) {
  const std::vector<std::pair<JointId, Vec3>> given = {{JointId(0), Vec3::Zero()},
                                                       {JointId(3), Vec3(3, 0, -3)}};
  const auto spread = spread_translations(straight_chain(4), given);
  EXPECT_THAT(spread[1], IsNearVec(Vec3(1, 0, -1), kRounding));
  EXPECT_THAT(spread[2], IsNearVec(Vec3(2, 0, -2), kRounding));
}

// Sec. 4.1: "when a single node is merged, the translation is propagated unaltered".
TEST(SpreadTranslations, OneGivenJointMovesAll) {
  const std::vector<std::pair<JointId, Vec3>> given = {{JointId(7), Vec3(1, 2, 3)}};
  for (const Vec3& t : spread_translations(random_skeleton(20, 3), given))
    EXPECT_THAT(t, IsNearVec(Vec3(1, 2, 3), kRounding));
}

TEST(SpreadTranslations, NothingGivenMovesNothing) {
  for (const Vec3& t : spread_translations(straight_chain(3), {})) EXPECT_EQ(t, Vec3::Zero());
}

// Law: every free joint is the mean of its neighbours.
TEST(SpreadTranslations, FreeJointsAreTheMeanOfTheirNeighbours) {
  const Skeleton s = random_skeleton(60, 4);
  const std::vector<std::pair<JointId, Vec3>> given = {
      {JointId(5), Vec3(1, 0, 0)}, {JointId(23), Vec3(0, 4, 0)}, {JointId(41), Vec3(0, 0, -2)}};
  const auto spread = spread_translations(s, given);
  std::vector<Vec3> sum(s.size(), Vec3::Zero());
  std::vector<int> count(s.size(), 0);
  for (std::size_t j = 1; j < s.size(); ++j) {
    const std::size_t parent = s.joints[j].parent.index();
    sum[j] += spread[parent];
    sum[parent] += spread[j];
    ++count[j];
    ++count[parent];
  }
  for (std::size_t j = 0; j < s.size(); ++j) {
    if (j == 5 || j == 23 || j == 41) continue;
    EXPECT_THAT(spread[j], IsNearVec(Vec3(sum[j] / count[j]), kRounding)) << j;
  }
  EXPECT_EQ(spread[23], Vec3(0, 4, 0));
}

}  // namespace
}  // namespace skinforge
