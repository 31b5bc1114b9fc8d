#include "render/visibility.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <random>
#include <set>

namespace skinforge {
namespace {

constexpr int kSize = VisibilityTile::kEdge;
constexpr double kRounding = 1e-9;  // pixels; coordinates up to 32 through one matrix inverse

// An eye at distance 1 whose picture is kSize pixels: the plane z = 0 shows x, y in [-tan(fov/2),
// tan(fov/2)].
View unit_view() {
  return {.eye = Vec3(0, 0, 1)};
}

// Model point in the plane z = 0 that projects to picture point (x, y).
Vec3 at_pixel(const Projection& projection, double x, double y) {
  const Vec3 ray = projection.ray(x, y);
  return projection.eye - projection.eye.z() / ray.z() * ray;
}

std::int64_t samples_of(const VisibilityTile& tile, std::int32_t owner) {
  std::int64_t count = 0;
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x)
      count += std::count(tile.owners(x, y).begin(), tile.owners(x, y).end(), owner);
  return count;
}

TEST(Visibility, SamplesHaveOwnRowsAndColumns) {
  std::set<float> xs, ys;
  for (int s = 0; s < kSamples; ++s) {
    const auto [x, y] = sample_offset(s);
    EXPECT_LT(std::max(std::abs(x), std::abs(y)), 0.5F);
    xs.insert(x);
    ys.insert(y);
  }
  EXPECT_EQ(xs.size(), static_cast<std::size_t>(kSamples));
  EXPECT_EQ(ys.size(), static_cast<std::size_t>(kSamples));
}

TEST(Visibility, ProjectionByHand) {
  const Projection projection(unit_view(), kSize, kSize);
  const Vec3 center = projection(Vec3::Zero());
  EXPECT_NEAR(center.x() / center.z(), kSize / 2.0, kRounding);
  EXPECT_NEAR(center.z(), 1, kRounding);
  const Vec3 above = projection(Vec3(0, std::tan(unit_view().fov / 2), 0));
  EXPECT_NEAR(above.y() / above.z(), 0, kRounding);  // top edge
  EXPECT_TRUE(at_pixel(projection, 5, 7).isApprox(at_pixel(projection, 5, 7)));
}

// A right triangle over half of a square of 8 x 8 pixels. The lattice has four samples on a pixel's diagonal
// (i = 5 i mod 16), so 32 of the square's 1024 lie on the long side: 496 are inside for sure, 528 with all of
// those.
TEST(Visibility, CoverageByHand) {
  const Projection projection(unit_view(), kSize, kSize);
  const auto corner = [&](double x, double y) { return projection(at_pixel(projection, x, y)); };
  const auto triangle = screen_triangle({corner(4, 4), corner(4, 12), corner(12, 12)}, projection);
  ASSERT_TRUE(triangle);
  EXPECT_TRUE(triangle->is_front);  // counter-clockwise as seen
  VisibilityTile tile(0, 0, 0.01);
  tile.draw(*triangle, 3);
  EXPECT_GE(samples_of(tile, 3), 496);
  EXPECT_LE(samples_of(tile, 3), 528);
  EXPECT_EQ(tile.owners(20, 20)[0], VisibilityTile::kNone);
}

TEST(Visibility, BarycentricAndEdgeDistance) {
  const Projection projection(unit_view(), kSize, kSize);
  const auto corner = [&](double x, double y) { return projection(at_pixel(projection, x, y)); };
  const auto triangle = screen_triangle({corner(4, 4), corner(4, 12), corner(12, 12)}, projection);
  EXPECT_TRUE(triangle->barycentric(4, 4).isApprox(Vec3(1, 0, 0), kRounding));
  EXPECT_TRUE(triangle->barycentric(4, 8).isApprox(Vec3(0.5, 0.5, 0), kRounding));
  EXPECT_NEAR(triangle->edge_distance(2, 6, 9), 2, kRounding);  // from the side x = 4
  EXPECT_NEAR(triangle->edge_distance(0, 6, 9), 3, kRounding);  // from the side y = 12
}

// A fan of random triangles that covers the whole block: each sample belongs to one of them, none is left
// out.
TEST(Visibility, NeighboursLeaveNoGap) {
  const Projection projection(unit_view(), kSize, kSize);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(2, kSize - 2.0);
  for (int round = 0; round < 50; ++round) {
    const Vec3 center = projection(at_pixel(projection, place(random), place(random)));
    std::vector<Vec3> ring;
    for (const auto& [x, y] : {std::pair{-3.0, -3.0},
                               {place(random), -3.0},
                               {35.0, -3.0},
                               {35.0, place(random)},
                               {35.0, 35.0},
                               {place(random), 35.0},
                               {-3.0, 35.0},
                               {-3.0, place(random)}})
      ring.push_back(projection(at_pixel(projection, x, y)));
    VisibilityTile tile(0, 0, 0.01);
    for (std::size_t i = 0; i < ring.size(); ++i)
      tile.draw(*screen_triangle({center, ring[(i + 1) % ring.size()], ring[i]}, projection), 1);
    EXPECT_EQ(samples_of(tile, VisibilityTile::kNone), 0);
  }
}

TEST(Visibility, NearestWinsWhateverTheOrder) {
  const Projection projection(unit_view(), kSize, kSize);
  const auto square = [&](double z) {
    return screen_triangle(
        {projection(Vec3(-5, -5, z)), projection(Vec3(5, -5, z)), projection(Vec3(0, 5, z))}, projection);
  };
  for (const bool near_first : {true, false}) {
    VisibilityTile tile(0, 0, 0.01);
    tile.draw(*square(near_first ? 0.5 : 0.1), near_first ? 1 : 2);
    tile.draw(*square(near_first ? 0.1 : 0.5), near_first ? 2 : 1);
    EXPECT_EQ(samples_of(tile, 1), kSize * kSize * kSamples);
  }
}

// One corner far behind the eye: the part before it is drawn, right up to where it leaves the picture.
TEST(Visibility, TriangleThroughTheEyePlane) {
  const Projection projection(unit_view(), kSize, kSize);
  const auto floor = screen_triangle(
      {projection(Vec3(-50, -0.1, -50)), projection(Vec3(50, -0.1, -50)), projection(Vec3(0, -0.1, 50))},
      projection);
  ASSERT_TRUE(floor);
  VisibilityTile tile(0, 0, 0.01);
  tile.draw(*floor, 1);
  EXPECT_EQ(tile.owners(kSize / 2, kSize - 1)[0], 1);              // below the horizon
  EXPECT_EQ(tile.owners(kSize / 2, 2)[0], VisibilityTile::kNone);  // above it
}

TEST(Visibility, DegenerateAndHiddenTrianglesAreNone) {
  const Projection projection(unit_view(), kSize, kSize);
  const Vec3 a = projection(Vec3(0, 0, 0)), behind = projection(Vec3(0, 0, 3));
  EXPECT_FALSE(screen_triangle({a, a, a}, projection));
  EXPECT_FALSE(screen_triangle({projection(Vec3(0, 0, 2)), projection(Vec3(1, 0, 3)), behind}, projection));
  EXPECT_FALSE(screen_triangle(
      {projection(Vec3(90, 0, 0)), projection(Vec3(91, 0, 0)), projection(Vec3(90, 1, 0))}, projection));
  EXPECT_FALSE(screen_triangle({a, projection(Vec3(1, 0, 0)), Vec3::Constant(std::nan(""))}, projection));
}

TEST(Visibility, CutoutTakesSamplesAway) {
  const Projection projection(unit_view(), kSize, kSize);
  const auto all = screen_triangle(
      {projection(Vec3(-5, -5, 0)), projection(Vec3(5, -5, 0)), projection(Vec3(0, 5, 0))}, projection);
  VisibilityTile tile(0, 0, 0.01);
  tile.draw(*all, 1, [](double x, double, int) { return x < 8; });
  EXPECT_EQ(samples_of(tile, 1), 8 * kSize * kSamples);
}

}  // namespace
}  // namespace skinforge
