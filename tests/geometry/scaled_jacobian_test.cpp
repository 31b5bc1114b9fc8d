#include "geometry/scaled_jacobian.h"

#include <gtest/gtest.h>

#include <array>
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

// A trapezium with corners of 90, 45, 135 and 90 degrees; of a right isosceles triangle shares of sin 60.
TEST(ScaledJacobian, CornersByHand) {
  const double h = std::sqrt(0.5);
  const std::vector<Vec3> quad = {{0, 0, 0}, {2, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const CornerJacobians of_quad = corner_jacobians(quad);
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_NEAR(of_quad.corner[k], (std::array{1.0, h, h, 1.0}[k]), kRounding) << k;
  EXPECT_NEAR((of_quad.normal - Vec3::UnitZ()).norm(), 0, kRounding);
  const std::vector<Vec3> triangle = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const CornerJacobians of_triangle = corner_jacobians(triangle);
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_NEAR(of_triangle.corner[k], (std::array{1.0, h * 2 / std::sqrt(3.0), h * 2 / std::sqrt(3.0)}[k]),
                kRounding)
        << k;
  const std::vector<Vec3> flat = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}},
                          pinched = {{0, 0, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  for (const auto& bad : {flat, pinched})
    for (const double corner : corner_jacobians(bad).corner) EXPECT_EQ(corner, -1);
}

}  // namespace
}  // namespace skinforge
