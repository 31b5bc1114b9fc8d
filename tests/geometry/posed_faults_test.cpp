#include "geometry/posed_faults.h"

#include <gtest/gtest.h>

namespace skinforge {
namespace {

// A strip in the plane y = 0 along x, of squares cut in two: x in [0, 1] belongs to source 0, [1, 2] is new,
// [2, 3] belongs to source 1.
struct Strip {
  std::vector<Vec3> rest;
  std::vector<TriangleCornerIds> triangles;
  std::vector<std::int32_t> parts = {0, 0, -1, -1, 1, 1};

  Strip() {
    for (int x = 0; x < 4; ++x)
      for (int z = 0; z < 2; ++z) rest.push_back(Vec3(x, 0, z));
    for (std::int32_t i = 0; i < 3; ++i) {
      triangles.push_back({2 * i, 2 * i + 1, 2 * i + 2});
      triangles.push_back({2 * i + 2, 2 * i + 1, 2 * i + 3});
    }
  }
};

TEST(PosedFaults, NothingAtRest) {
  const Strip strip;
  const PosedFaults faults = PosedSurface(strip.rest, strip.triangles, strip.parts).measure(strip.rest);
  EXPECT_EQ(faults.folds, 0U);
  EXPECT_EQ(faults.intersections, 0U);
  EXPECT_EQ(faults.stretch, 1);
  EXPECT_TRUE(faults.triangles.empty());
}

// By hand: the last square moves away by 2, so the new edges along x grow from 1 to 3.
TEST(PosedFaults, Stretch) {
  const Strip strip;
  std::vector<Vec3> posed = strip.rest;
  for (std::size_t v = 4; v < 8; ++v) posed[v].x() += 2;
  EXPECT_DOUBLE_EQ(PosedSurface(strip.rest, strip.triangles, strip.parts).measure(posed).stretch, 3);
}

// By hand: turned over at x = 2 by 170 degrees, source 1 lies on the new square; at 90 degrees it does not.
TEST(PosedFaults, Folds) {
  const Strip strip;
  const PosedSurface surface(strip.rest, strip.triangles, strip.parts);
  for (const auto& [degrees, folds] : {std::pair{90, 0U}, {170, 1U}}) {
    std::vector<Vec3> posed = strip.rest;
    const double angle = radians(degrees);
    for (const std::size_t v : {6, 7}) posed[v] = Vec3(2 + std::cos(angle), std::sin(angle), posed[v].z());
    EXPECT_EQ(surface.measure(posed).folds, folds) << degrees;
  }
}

// By hand: the last square stands on end in the middle of the first one, and cuts it. Squares of one source
// may do so, because that is how the input moves.
TEST(PosedFaults, Intersections) {
  Strip strip;
  std::vector<Vec3> posed = strip.rest;
  posed[4] = Vec3(0.5, 2, 0.1);
  posed[5] = Vec3(0.5, 2, 0.9);
  posed[6] = Vec3(0.5, -1, 0.1);
  posed[7] = Vec3(0.5, -1, 0.9);
  const PosedFaults faults = PosedSurface(strip.rest, strip.triangles, strip.parts).measure(posed);
  EXPECT_GE(faults.intersections, 2U);
  EXPECT_GE(faults.triangles.size(), 3U);
  EXPECT_EQ(PosedSurface(posed, strip.triangles, strip.parts).measure(posed).intersections, 0U);  // at rest
  strip.parts.assign(6, 0);
  EXPECT_EQ(PosedSurface(strip.rest, strip.triangles, strip.parts).measure(posed).intersections, 0U);
}

}  // namespace
}  // namespace skinforge
