#include "render/color.h"

#include <gmock/gmock.h>

#include <cmath>

namespace skinforge {
namespace {

constexpr double kFloat = 1e-6;  // one rounding to float

// IEC 61966-2-1 by hand: 0 -> 0, 255 -> 1, code 10 is on the straight part (10 / 255 / 12.92), code 188 is
// about one half.
TEST(Color, SrgbByHand) {
  EXPECT_EQ(linear_from_srgb(0), 0);
  EXPECT_EQ(linear_from_srgb(255), 1);
  EXPECT_NEAR(linear_from_srgb(10), 10 / 255.0 / 12.92, kFloat);
  EXPECT_EQ(srgb_from_linear(0.5F), 188);
}

TEST(Color, SrgbRoundTripsEveryCode) {
  for (int code = 0; code < 256; ++code)
    EXPECT_EQ(srgb_from_linear(linear_from_srgb(static_cast<std::uint8_t>(code))), code);
}

TEST(Color, ValuesOutsideTheRangeAreCut) {
  EXPECT_EQ(srgb_from_linear(-1), 0);
  EXPECT_EQ(srgb_from_linear(7), 255);
  EXPECT_EQ(srgb_from_linear(std::nanf("")), 0);
}

// OKLab: lightness 1 without chroma is white, and a grey of lightness 0.5 has linear value 0.5^3.
TEST(Color, OklchGreys) {
  EXPECT_TRUE(oklch_color(1, 0, 0).isApprox(Vec3(1, 1, 1), 1e-5));  // the printed matrix has ten digits
  EXPECT_TRUE(oklch_color(0.5, 0, 0.3).isApprox(Vec3::Constant(0.125), 1e-5));
}

TEST(Color, OklchStaysInsideSrgb) {
  for (int i = 0; i < 36; ++i) {
    const Vec3 color = oklch_color(0.7, 0.5, i / 36.0);
    EXPECT_GE(color.minCoeff(), 0);
    EXPECT_LE(color.maxCoeff(), 1);
  }
}

TEST(Color, JointColorsAreStableAndDistinct) {
  const auto few = joint_colors(5), many = joint_colors(60);
  for (std::size_t i = 0; i < few.size(); ++i) EXPECT_EQ(few[i], many[i]);
  for (std::size_t i = 0; i < many.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) EXPECT_GT((many[i] - many[j]).norm(), 0.004) << i << " and " << j;
  for (std::size_t i = 0; i + 1 < many.size(); ++i) EXPECT_GT((many[i] - many[i + 1]).norm(), 0.25);
}

TEST(Color, DominantJointPaintsTheVertex) {
  SkinWeights weights;
  const std::vector<Influence> row{{JointId(0), 0.4}, {JointId(2), 0.6}};
  weights.push_row(row);
  weights.push_row({});
  const auto colors = dominant_weight_colors(weights, 3);
  ASSERT_EQ(colors.size(), 2U);
  EXPECT_EQ(colors[0], joint_colors(3)[2]);
  EXPECT_DOUBLE_EQ(colors[1].x(), colors[1].y());  // grey
}

TEST(Color, HeatGetsDarkerAllTheWay) {
  const Vec3 luminance(0.2126, 0.7152, 0.0722);
  for (int i = 0; i < 20; ++i)
    EXPECT_GT(heat_color(i / 20.0).dot(luminance), heat_color((i + 1) / 20.0).dot(luminance));
  EXPECT_EQ(heat_color(-3), heat_color(0));
  EXPECT_EQ(heat_color(9), heat_color(1));
}

TEST(Color, JointWeightColorsShowOneJoint) {
  SkinWeights weights;
  const std::vector<Influence> row{{JointId(1), 0.75}, {JointId(0), 0.25}};
  weights.push_row(row);
  EXPECT_EQ(joint_weight_colors(weights, JointId(1))[0], heat_color(0.75));
  EXPECT_EQ(joint_weight_colors(weights, JointId(5))[0], heat_color(0));
}

}  // namespace
}  // namespace skinforge
