#include "skeleton/joint_similarity.h"

#include <gtest/gtest.h>

#include "skeletons.h"

namespace skinforge {
namespace {
using namespace testing;
constexpr double kRounding = 1e-12;  // a dozen operations on numbers near 1

// Chain root-a-b, mapped onto itself; b is open and a = B(a). By hand: candidate a is the image itself,
// so local is undefined, global is 1, k = 2, P = 0.5 against 1, valence 2 against 1.
TEST(JointSimilarity, CandidateThatIsTheImage) {
  const SkeletonShape chain(straight_chain(3));
  const MapStep step{.joint = kB, .mapped = kA, .image = kA};
  EXPECT_NEAR(joint_similarity(chain, chain, step, kB).score(), 1.0, kRounding);
  EXPECT_NEAR(joint_similarity(chain, chain, step, kA).score(), 0.3 + 0.15 + 0.15 + 0.05, kRounding);
}

// By hand: going from a to the root, the candidate b lies the other way (local -1 counts 0, no global at the
// source's root), one edge away, P = 1 against 0, valences equal.
TEST(JointSimilarity, OppositeDirectionCountsZero) {
  const SkeletonShape chain(straight_chain(3));
  const JointSimilarity s = joint_similarity(chain, chain, {.joint = kRoot, .mapped = kA, .image = kA}, kB);
  EXPECT_EQ(s.geometric, 0);
  EXPECT_EQ(s.topological, 1);
  EXPECT_EQ(s.parametric, 0);
  EXPECT_EQ(s.valence, 1);
}

TEST(JointSimilarity, TwoLoneJointsAreAlikeButForDirections) {
  const SkeletonShape lone(straight_chain(1));
  const JointSimilarity s = joint_similarity(lone, lone, {kRoot, kRoot, kRoot}, kRoot);
  EXPECT_EQ(s.geometric, 0);
  EXPECT_EQ(s.valence, 1);
  EXPECT_NEAR(s.score(), 0.15 + 0.3 + 0.1, kRounding);
}

// Law: translation and uniform scale of either skeleton change nothing.
TEST(JointSimilarity, UnchangedByTranslationAndScale) {
  const Skeleton s = random_skeleton(20, 1), t = random_skeleton(25, 2);
  const SkeletonShape a(s), b(t);
  const SkeletonShape moved(s, {1e4, Quat::Identity(), Vec3(5, -3, 8)});
  const SkeletonShape tiny(t, {1e-6, Quat::Identity(), Vec3(0.1, 0, 0)});
  constexpr double kCancellation = 1e-8;  // a skeleton of 1e-6 at 0.1 keeps ten digits
  for (int j = 1; j < 20; ++j) {
    const MapStep step{JointId(j), s.joints[static_cast<std::size_t>(j)].parent, JointId(j)};
    for (int c = 0; c < 25; ++c)
      EXPECT_NEAR(joint_similarity(a, b, step, JointId(c)).score(),
                  joint_similarity(moved, tiny, step, JointId(c)).score(), kCancellation);
  }
}

// Sec. 5.1, by hand: a root with one leaf at distance 1 and another behind a joint at 1, at distance 4. The
// inner joint lies on one path, 1/4 along it. The root is 0, leaves are 1.
TEST(SkeletonShape, ParametricPositionByHand) {
  const SkeletonShape shape(make_skeleton(
      {{"r"}, {"short", 0, Vec3(0, 1, 0)}, {"inner", 0, Vec3(1, 0, 0)}, {"leaf", 2, Vec3(3, 0, 0)}}));
  EXPECT_EQ(shape.parametric(JointId(0)), 0);
  EXPECT_NEAR(shape.parametric(JointId(1)), 1, kRounding);
  EXPECT_NEAR(shape.parametric(JointId(2)), 0.25, kRounding);
  EXPECT_NEAR(shape.parametric(JointId(3)), 1, kRounding);
}

// Two leaves at 2 and 4 behind an inner joint at 1: the mean of 1/2 and 1/4.
TEST(SkeletonShape, ParametricPositionAveragesPaths) {
  const SkeletonShape shape(make_skeleton(
      {{"r"}, {"inner", 0, Vec3(1, 0, 0)}, {"near", 1, Vec3(1, 0, 0)}, {"far", 1, Vec3(3, 0, 0)}}));
  EXPECT_NEAR(shape.parametric(JointId(1)), 0.375, kRounding);
}

// Bones without length count edges: a chain of three joints in one point is 0, 1/2, 1.
TEST(SkeletonShape, BonesWithoutLength) {
  const SkeletonShape shape(make_skeleton({{"a"}, {"b", 0}, {"c", 1}}));
  EXPECT_NEAR(shape.parametric(JointId(1)), 0.5, kRounding);
  EXPECT_NEAR(shape.parametric(JointId(2)), 1, kRounding);
  EXPECT_FALSE(shape.direction(JointId(0), JointId(2)).has_value());
}

TEST(SkeletonShape, HopsAndValences) {
  const SkeletonShape shape(make_skeleton({{"r"}, {"a", 0}, {"b", 0}, {"a1", 1}, {"b1", 2}}));
  EXPECT_EQ(shape.hops(JointId(3), JointId(4)), 4);
  EXPECT_EQ(shape.hops(JointId(4), JointId(0)), 2);
  EXPECT_EQ(shape.hops(JointId(3), JointId(3)), 0);
  EXPECT_EQ(shape.valence(JointId(0)), 2);
  EXPECT_EQ(shape.valence(JointId(1)), 2);
  EXPECT_EQ(shape.valence(JointId(3)), 1);
}

}  // namespace
}  // namespace skinforge
