#include "field/signed_distance.h"

#include <gtest/gtest.h>

#include "testing/fields.h"

namespace skinforge {
namespace {

constexpr double kFloat = 1e-6;  // values are stored in float, of size 1

// f(x, y, z) = x + 2 y - 3 z on a lattice away from the origin: trilinear interpolation is exact for it.
TEST(DistanceField, LinearFunctionIsExact) {
  const Lattice lattice{.origin = Vec3(1, -1, 2), .voxel = 0.25, .size = {5, 4, 6}};
  const DistanceField field =
      testing::sampled(lattice, [](const Vec3& p) { return p.x() + 2 * p.y() - 3 * p.z(); });
  EXPECT_NEAR(field.at({1.3, -0.6, 2.9}), 1.3 - 1.2 - 8.7, 10 * kFloat);
  EXPECT_NEAR(field.at({1, -1, 2}), -7, 10 * kFloat);
  EXPECT_TRUE(field.gradient({1.5, -0.6, 2.6}).isApprox(Vec3(1, 2, -3), 1e-5));
}

TEST(DistanceField, OutsideTakesTheNearestPoint) {
  const Lattice lattice{.origin = Vec3::Zero(), .voxel = 1, .size = {2, 2, 2}};
  const DistanceField field = testing::sampled(lattice, [](const Vec3& p) { return p.x(); });
  EXPECT_EQ(field.at({-5, 0.5, 0.5}), 0);
  EXPECT_EQ(field.at({9, 9, 9}), 1);
  const Lattice single{.origin = Vec3::Zero(), .voxel = 1, .size = {1, 1, 1}};
  EXPECT_EQ(testing::sampled(single, [](const Vec3&) { return 4.0; }).at({0.3, -2, 7}), 4);
}

}  // namespace
}  // namespace skinforge
