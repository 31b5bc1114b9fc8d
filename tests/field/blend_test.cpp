#include "field/blend.h"

#include <gtest/gtest.h>

#include <cmath>

namespace skinforge {
namespace {

constexpr double kRounding = 1e-14;  // a few products of numbers near 1

TEST(PresenceWeight, EndsMiddleAndQuarter) {
  EXPECT_EQ(presence_weight(0), 0);
  EXPECT_EQ(presence_weight(0.001), 0);
  EXPECT_EQ(presence_weight(0.999), 1);
  EXPECT_EQ(presence_weight(1), 1);
  EXPECT_NEAR(presence_weight(0.5), 0.5, kRounding);
  EXPECT_NEAR(presence_weight(0.2505), 0.15625, kRounding);  // t = 1/4: 3/16 - 2/64
}

// C1: no jump of the slope at either end of the ramp.
TEST(PresenceWeight, SlopeVanishesAtTheEnds) {
  const auto slope = [](double p) { return (presence_weight(p + 1e-6) - presence_weight(p - 1e-6)) / 2e-6; };
  EXPECT_LT(slope(0.001), 1e-5);
  EXPECT_LT(slope(0.999), 1e-5);
  EXPECT_GT(slope(0.5), 1.4);
}

TEST(BlendReplace, ByHand) {
  EXPECT_EQ(blend_replace(2, 1, -1, 0), 2);
  EXPECT_EQ(blend_replace(2, 0, -1, 1), -1);
  EXPECT_NEAR(blend_replace(2, 0.5, -1, 0.5), 0.5, kRounding);
  EXPECT_EQ(blend_replace(2, 1, -1, 0.5), 2);       // wholly present: decides alone
  EXPECT_EQ(blend_replace(2, 1, -1, 1), -1);        // both: the union
  EXPECT_EQ(blend_replace(2, 0, -1, 0), 0.5);       // nobody is present: the mean
  EXPECT_EQ(blend_replace(2, 0.0005, -1, 0), 0.5);  // present only within the tolerance
}

// Between the two distances, and the same with the sources exchanged.
TEST(BlendReplace, MeanAndSymmetric) {
  for (double p0 = 0; p0 <= 1; p0 += 0.125)
    for (double p1 = 0; p1 <= 1; p1 += 0.125) {
      const double d = blend_replace(3, p0, -2, p1);
      EXPECT_GE(d, -2 - kRounding);
      EXPECT_LE(d, 3 + kRounding);
      EXPECT_NEAR(d, blend_replace(-2, p1, 3, p0), kRounding);
    }
}

TEST(SmoothMin, ByHand) {
  EXPECT_EQ(smooth_min(2, -1, 0), -1);
  EXPECT_EQ(smooth_min(2, -1, 3), -1);                     // differ by the radius: exact
  EXPECT_NEAR(smooth_min(1, 1, 3), 0.5, kRounding);        // equal: lower by radius / 6
  EXPECT_NEAR(smooth_min(0, 1, 2), -1.0 / 24, kRounding);  // x = 1/2: 2 / (8 * 6)
  EXPECT_EQ(smooth_min(0, 1, 2), smooth_min(1, 0, 2));
}

TEST(SmoothMin, NeverAboveTheMinimumNorFarBelow) {
  for (double a = -2; a <= 2; a += 0.25)
    for (double b = -2; b <= 2; b += 0.25) {
      EXPECT_LE(smooth_min(a, b, 0.9), std::min(a, b));
      EXPECT_GE(smooth_min(a, b, 0.9), std::min(a, b) - 0.15 - kRounding);
    }
}

TEST(SmoothMax, MirrorsTheMinimum) {
  EXPECT_NEAR(smooth_max(1, 1, 3), 1.5, kRounding);
  EXPECT_EQ(smooth_max(2, -1, 3), 2);
}

// By hand: whole at a right angle and beyond, half at 60 degrees, next to nothing side by side.
TEST(FilletShare, ByHand) {
  EXPECT_EQ(fillet_share(Vec3::UnitX(), Vec3::UnitY()), 1);
  EXPECT_EQ(fillet_share(Vec3::UnitX(), -Vec3::UnitX()), 1);
  EXPECT_NEAR(fillet_share(Vec3::UnitX(), Vec3(0.5, std::sqrt(0.75), 0)), 0.5, kRounding);
  EXPECT_EQ(fillet_share(Vec3::UnitX(), Vec3::UnitX()), 0.05);
}

}  // namespace
}  // namespace skinforge
