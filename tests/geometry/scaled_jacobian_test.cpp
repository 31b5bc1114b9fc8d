#include "geometry/scaled_jacobian.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace skinforge {
namespace {

constexpr double kRounding = 1e-14;  // a few products of numbers near 1

TEST(ScaledJacobian, QuadsByHand) {
  EXPECT_NEAR(scaled_jacobian_of_quad({0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {0, 1, 0}), 1, kRounding);
  // A rhombus of 60 degrees: sin 60.
  const double h = std::sqrt(3.0) / 2;
  EXPECT_NEAR(scaled_jacobian_of_quad({0, 0, 0}, {1, 0, 0}, {1.5, h, 0}, {0.5, h, 0}), h, kRounding);
  // A dart: its third corner is bent in.
  EXPECT_LT(scaled_jacobian_of_quad({0, 0, 0}, {2, 0, 0}, {0.5, 0.5, 0}, {0, 2, 0}), 0);
  EXPECT_NEAR(scaled_jacobian_of_quad({0, 0, 0}, {2, 0, 0}, {1, 1, 0}, {0, 2, 0}), 0, kRounding);
  EXPECT_EQ(scaled_jacobian_of_quad({0, 0, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, 0}), -1);
  EXPECT_EQ(scaled_jacobian_of_quad({0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}), -1);
}

TEST(ScaledJacobian, TrianglesByHand) {
  EXPECT_NEAR(scaled_jacobian_of_triangle({0, 0, 0}, {1, 0, 0}, {0.5, std::sqrt(3.0) / 2, 0}), 1, kRounding);
  // Right and isosceles: least sine sin 45.
  EXPECT_NEAR(scaled_jacobian_of_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), std::sqrt(2.0 / 3), kRounding);
  EXPECT_EQ(scaled_jacobian_of_triangle({0, 0, 0}, {1, 0, 0}, {2, 0, 0}), 0);
}

TEST(ScaledJacobian, AnyPolygon) {
  const std::vector<Vec3> quad = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  EXPECT_NEAR(scaled_jacobian(quad), 1, kRounding);
  const std::vector<Vec3> triangle = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  EXPECT_NEAR(scaled_jacobian(triangle), std::sqrt(2.0 / 3), kRounding);
}

}  // namespace
}  // namespace skinforge
