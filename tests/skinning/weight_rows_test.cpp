#include "skinning/weight_rows.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace skinforge {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr double kRounding = 1e-12;  // a handful of sums and one division

Influence influence(int joint, double weight) {
  return {JointId(joint), weight};
}
MappedJoint to(int image, double confidence) {
  return {JointId(image), confidence};
}

testing::Matcher<Influence> near(int joint, double weight) {
  return testing::AllOf(testing::Field(&Influence::joint, JointId(joint)),
                        testing::Field(&Influence::weight, testing::DoubleNear(weight, kRounding)));
}

// Joints 0 and 2 fuse into joint 5: their weights add up and the row is sorted again. Full confidence keeps
// the bits.
TEST(RetargetedRow, SumsJointsOnOneImage) {
  const JointMap map = {to(5, 1), to(3, 1), to(5, 1)};
  const std::vector<Influence> row = {influence(1, 0.5), influence(0, 0.375), influence(2, 0.125)};
  EXPECT_THAT(retargeted_row(row, map), ElementsAre(influence(3, 0.5), influence(5, 0.5)));
}

TEST(RetargetedRow, FullConfidenceKeepsWeightsToTheBit) {
  const JointMap map = {to(7, 1), to(4, 1), to(0, 1), to(1, 1), to(9, 1)};
  const std::vector<Influence> row = {influence(0, 0.3), influence(1, 0.2), influence(2, 0.2),
                                      influence(3, 0.2), influence(4, 0.1)};
  EXPECT_THAT(retargeted_row(row, map), ElementsAre(influence(7, 0.3), influence(0, 0.2), influence(1, 0.2),
                                                    influence(4, 0.2), influence(9, 0.1)));
}

// By hand: 0.6 sure and 0.4 at confidence 0.5 are 0.6 : 0.2, so 0.75 and 0.25.
TEST(RetargetedRow, UnsureJointsWeighLess) {
  const JointMap map = {to(0, 1), to(1, 0.5)};
  EXPECT_THAT(retargeted_row(std::vector{influence(0, 0.6), influence(1, 0.4)}, map),
              ElementsAre(near(0, 0.75), near(1, 0.25)));
}

TEST(RetargetedRow, NoConfidenceAtAllStillMovesTheWeight) {
  const JointMap map = {to(2, 0), to(3, 0)};
  EXPECT_THAT(retargeted_row(std::vector{influence(0, 0.75), influence(1, 0.25)}, map),
              ElementsAre(near(2, 0.75), near(3, 0.25)));
  EXPECT_THAT(retargeted_row({}, map), IsEmpty());
}

TEST(Retarget, TakesEveryRow) {
  SkinWeights weights;
  weights.push_row(std::vector{influence(0, 1)});
  weights.push_row(std::vector{influence(1, 1)});
  const SkinWeights moved = retarget(weights, {to(4, 1), to(6, 1)});
  ASSERT_EQ(moved.vertex_count(), 2u);
  EXPECT_THAT(moved.of(VertexId(0)), ElementsAre(influence(4, 1)));
  EXPECT_THAT(moved.of(VertexId(1)), ElementsAre(influence(6, 1)));
}

// By hand: corners on joints 0, 1 and half and half; at (1/2, 1/4, 1/4) joint 0 has 1/2 + 1/8, joint 1 has
// 1/4 + 1/8.
TEST(InterpolateRow, MixesTheCorners) {
  SkinWeights weights;
  weights.push_row(std::vector{influence(0, 1)});
  weights.push_row(std::vector{influence(1, 1)});
  weights.push_row(std::vector{influence(0, 0.5), influence(1, 0.5)});
  const auto row = interpolate_row(weights, {VertexId(0), VertexId(1), VertexId(2)}, Vec3(0.5, 0.25, 0.25));
  EXPECT_THAT(row, ElementsAre(near(0, 0.625), near(1, 0.375)));
}

// By hand: 0.75 * (0: 0.6, 1: 0.4) + 0.25 * (2: 1) = (0: 0.45, 1: 0.3, 2: 0.25); the two largest are 0.6 and
// 0.4.
TEST(BlendRows, KeepsTheLargestAndRenormalises) {
  const std::vector<Influence> a = {influence(0, 0.6), influence(1, 0.4)}, b = {influence(2, 1)};
  const std::vector<RowShare> shares = {{a, 0.75}, {b, 0.25}};
  EXPECT_THAT(blend_rows(shares, 0), ElementsAre(near(0, 0.45), near(1, 0.3), near(2, 0.25)));
  EXPECT_THAT(blend_rows(shares, 2), ElementsAre(near(0, 0.6), near(1, 0.4)));
  EXPECT_THAT(blend_rows(std::vector<RowShare>{{a, 0}}, 4), IsEmpty());
}

TEST(RowDistance, CountsWhatDiffers) {
  const std::vector<Influence> a = {influence(0, 0.6), influence(1, 0.4)}, b = {influence(2, 1)};
  const std::vector<Influence> c = {influence(1, 0.7), influence(0, 0.3)};
  EXPECT_NEAR(row_distance(a, b), 2, kRounding);
  EXPECT_NEAR(row_distance(a, c), 0.6, kRounding);
  EXPECT_EQ(row_distance(a, a), 0);
}

}  // namespace
}  // namespace skinforge
