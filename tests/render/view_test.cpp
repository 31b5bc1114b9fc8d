#include "render/view.h"

#include <gmock/gmock.h>

#include <cmath>
#include <random>
#include <vector>

#include "render/visibility.h"

namespace skinforge {
namespace {

constexpr double kRounding = 1e-12;  // a few dozen products in double

TEST(View, AnglesByHand) {
  EXPECT_TRUE((ViewAngles{0, 0}).direction().isApprox(Vec3(0, 0, 1)));
  EXPECT_TRUE((ViewAngles{radians(90), 0}).direction().isApprox(Vec3(1, 0, 0), kRounding));
  EXPECT_TRUE((ViewAngles{0, radians(90)}).direction().isApprox(Vec3(0, 1, 0), kRounding));
}

TEST(View, AxesAreARightHandedFrame) {
  const View view{.eye = Vec3::Zero(), .angles = {0.7, -0.4}};
  const Mat3 axes = view.axes();
  EXPECT_TRUE((axes.transpose() * axes).isApprox(Mat3::Identity(), kRounding));
  EXPECT_NEAR(axes.determinant(), 1, kRounding);
  EXPECT_GT(axes.col(1).y(), 0);  // up is up
}

// Two points at x = -1 and 1 in a square picture without margin: the eye stands where the half opening spans
// 1 m.
TEST(View, FitsTwoPointsByHand) {
  const std::vector<Vec3> points{Vec3(-1, 0, 0), Vec3(1, 0, 0)};
  const View view = fit_view(points, {}, 1, 0);
  EXPECT_TRUE(view.eye.isApprox(Vec3(0, 0, 1 / std::tan(view.fov / 2)), kRounding));
}

// Every point falls inside the picture less its margin, and on at least one side a point touches that frame.
TEST(View, FitIsTight) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  for (int round = 0; round < 20; ++round) {
    std::vector<Vec3> points;
    for (int i = 0; i < 12; ++i)
      points.emplace_back(3 * coordinate(random), coordinate(random), 2 * coordinate(random));
    constexpr double kWidth = 300, kHeight = 200, kMargin = 0.1;
    const View view =
        fit_view(points, {3 * coordinate(random), coordinate(random)}, kWidth / kHeight, kMargin);
    const Projection projection(view, static_cast<int>(kWidth), static_cast<int>(kHeight));
    double least = kWidth;
    for (const Vec3& p : points) {
      const Vec3 q = projection(p);
      ASSERT_GT(q.z(), view.near);
      const double x = q.x() / q.z() / kWidth, y = q.y() / q.z() / kHeight;
      least = std::min({least, x, 1 - x, y, 1 - y});
    }
    EXPECT_NEAR(least, kMargin, 1e-9);
  }
}

TEST(View, FitDoesNotDependOnScale) {
  const std::vector<Vec3> points{Vec3(-1, 0, 0.5), Vec3(1, 2, 0), Vec3(0.3, -1, -1)};
  std::vector<Vec3> large;
  for (const Vec3& p : points) large.push_back(128 * p);  // a power of two: no rounding of its own
  const View a = fit_view(points, {0.5, 0.2}), b = fit_view(large, {0.5, 0.2});
  EXPECT_TRUE(b.eye.isApprox(128 * a.eye, kRounding));
  EXPECT_NEAR(b.near, 128 * a.near, 128 * kRounding);
}

TEST(View, NothingOrOnePointGivesAUsableView) {
  const std::vector<Vec3> one{Vec3(4, 5, 6)};
  EXPECT_TRUE(fit_view(one, {}).eye.isApprox(Vec3(4, 5, 7)));
  EXPECT_TRUE(fit_view(std::span<const Vec3>(), {}).eye.isApprox(Vec3(0, 0, 1)));
}

// A ball of radius 1: the ray that touches it makes the half angle, so distance = 1 / sin(half angle).
TEST(View, FitsABall) {
  const View view = fit_view(Vec3(1, 2, 3), 1, {}, 1, 0);
  EXPECT_NEAR((view.eye - Vec3(1, 2, 3)).norm(), 1 / std::sin(view.fov / 2), kRounding);
}

}  // namespace
}  // namespace skinforge
