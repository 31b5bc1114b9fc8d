#include "geometry/triangle_math.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>
#include <span>
#include <vector>

namespace skinforge {
namespace {

constexpr double kRounding = 1e-12;  // some ten products of numbers near 1
const TriangleCorners kRight = {Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0)};

// Every region of the plane around the right triangle, by hand.
TEST(ClosestBarycentric, EachRegion) {
  const auto nearest = [](const Vec3& p) { return interpolate(kRight, closest_barycentric(p, kRight)); };
  EXPECT_EQ(nearest({-1, -2, 3}), Vec3(0, 0, 0));
  EXPECT_EQ(nearest({7, -1, 3}), Vec3(4, 0, 0));
  EXPECT_EQ(nearest({-1, 7, 3}), Vec3(0, 4, 0));
  EXPECT_EQ(nearest({1, -5, 1}), Vec3(1, 0, 0));
  EXPECT_EQ(nearest({-5, 3, 1}), Vec3(0, 3, 0));
  EXPECT_EQ(nearest({5, 3, 1}), Vec3(3, 1, 0));
  EXPECT_EQ(nearest({1, 1, 9}), Vec3(1, 1, 0));
}

TEST(ClosestBarycentric, DegenerateTriangles) {
  const TriangleCorners twice = {Vec3(0, 0, 0), Vec3(0, 0, 0), Vec3(0, 4, 0)};  // a segment
  EXPECT_EQ(interpolate(twice, closest_barycentric({1, 3, 0}, twice)), Vec3(0, 3, 0));
  const TriangleCorners line = {Vec3(1, 0, 0), Vec3(3, 0, 0), Vec3(2, 0, 0)};  // collinear, distinct
  EXPECT_EQ(interpolate(line, closest_barycentric({2.5, 1, 0}, line)), Vec3(2.5, 0, 0));
  const TriangleCorners point = {Vec3(1, 1, 1), Vec3(1, 1, 1), Vec3(1, 1, 1)};
  EXPECT_EQ(interpolate(point, closest_barycentric({0, 0, 0}, point)), Vec3(1, 1, 1));
  EXPECT_TRUE(is_degenerate(twice) && is_degenerate(line) && is_degenerate(point));
  EXPECT_FALSE(is_degenerate(kRight));
}

// No point of a fine sampling of the triangle is nearer than the answer.
TEST(ClosestBarycentric, BeatsSampling) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  const auto point = [&] { return Vec3(normal(random), normal(random), normal(random)); };
  for (int trial = 0; trial < 200; ++trial) {
    const TriangleCorners t = {point(), point(), point()};
    const Vec3 p = 2 * point();
    const Vec3 b = closest_barycentric(p, t);
    EXPECT_NEAR(b.sum(), 1, kRounding);
    EXPECT_GE(b.minCoeff(), 0);
    const double distance = (p - interpolate(t, b)).norm();
    for (int i = 0; i <= 20; ++i)
      for (int j = 0; i + j <= 20; ++j) {
        const Vec3 sample = interpolate(t, Vec3(i, j, 20 - i - j) / 20);
        EXPECT_GE((p - sample).norm(), distance - kRounding);
      }
  }
}

// One face of an octahedron fills an eighth of the sphere seen from its centre.
TEST(SolidAngle, OctahedronFace) {
  const TriangleCorners face = {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
  const TriangleCorners back = {face[0], face[2], face[1]};
  EXPECT_NEAR(solid_angle(Vec3::Zero(), std::span(&face, 1)), std::numbers::pi / 2, kRounding);
  EXPECT_NEAR(solid_angle(Vec3::Zero(), std::span(&back, 1)), -std::numbers::pi / 2, kRounding);
  EXPECT_EQ(solid_angle({1, 1, 0}, std::span(&kRight, 1)), 0);  // in the plane
  EXPECT_EQ(solid_angle({9, 9, 0}, std::span(&kRight, 1)), 0);
}

// Sums beyond whole turns: the same face seen 30 times, from close by, with its reverse once.
TEST(SolidAngle, ManyTurnsAddUp) {
  const Vec3 near(1, 1, -0.01);
  const TriangleCorners back = {kRight[0], kRight[2], kRight[1]};
  const double one = solid_angle(near, std::span(&kRight, 1));
  EXPECT_GT(one, 6);
  std::vector<TriangleCorners> many(30, kRight);
  EXPECT_NEAR(solid_angle(near, many), 30 * one, 30 * kRounding);
  many.push_back(back);
  EXPECT_NEAR(solid_angle(near, many), 29 * one, 30 * kRounding);
  EXPECT_NEAR(solid_angle(near, std::vector<TriangleCorners>(30, back)), -30 * one, 30 * kRounding);
  EXPECT_EQ(solid_angle(near, {}), 0);
}

TEST(RayParameter, HitsFromBothSidesAndMisses) {
  EXPECT_NEAR(ray_parameter({1, 1, 6}, {0, 0, -2}, kRight).value(), 3, kRounding);
  EXPECT_NEAR(ray_parameter({1, 1, -6}, {0, 0, 2}, kRight).value(), 3, kRounding);
  EXPECT_FALSE(ray_parameter({1, 1, 6}, {0, 0, 1}, kRight));   // behind
  EXPECT_FALSE(ray_parameter({3, 3, 6}, {0, 0, -1}, kRight));  // beside
  EXPECT_FALSE(ray_parameter({-1, 1, 0}, {1, 0, 0}, kRight));  // in the plane
  EXPECT_FALSE(ray_parameter({1, 1, 6}, {0, 0, -1}, {Vec3(0, 0, 0), Vec3(1, 1, 0), Vec3(2, 2, 0)}));
}

}  // namespace
}  // namespace skinforge
