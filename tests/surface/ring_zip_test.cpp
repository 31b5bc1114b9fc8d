#include "surface/ring_zip.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "surface/shapes.h"

namespace skinforge {
namespace {

using ::testing::Contains;

constexpr double kRounding = 1e-12;  // sums of a few dozen areas

TrianglePatch zipped(std::vector<Vec3> a, const std::vector<Vec3>& c, const OutwardDirection& outward) {
  const std::vector<Triangle> triangles = zip_rings(a, c, outward);
  const std::size_t fixed = a.size() + c.size();
  a.insert(a.end(), c.begin(), c.end());
  return {a, triangles, fixed};
}

// Each edge of `a` forwards once, each of `c` backwards once, all other half-edges with a partner.
void expect_closed_ring(const TrianglePatch& patch, std::size_t a_count) {
  const auto n = static_cast<std::int32_t>(a_count), all = static_cast<std::int32_t>(patch.fixed),
             m = all - n;
  ASSERT_EQ(patch.triangles.size(), patch.fixed);
  auto uses = testing::half_edge_uses(patch.triangles);
  for (const auto& [edge, number] : uses) EXPECT_EQ(number, 1);
  for (std::int32_t i = 0; i < n; ++i) EXPECT_EQ(uses.erase({i, (i + 1) % n}), 1u);
  for (std::int32_t j = 0; j < m; ++j) EXPECT_EQ(uses.erase({n + (j + 1) % m, n + j}), 1u);
  for (const auto& [edge, number] : uses) EXPECT_TRUE(uses.contains({edge.second, edge.first}));
}

Vec3 away_from_axis(const Vec3& p) {
  return Vec3(p.x(), 0, p.z());
}

// Two squares one above the other: eight triangles, the sides of a prism, each with area 1/2 * sqrt(2) * 1.
TEST(ZipRings, SquarePrism) {
  const TrianglePatch patch = zipped(testing::ring(4), testing::ring(4, 1, 1), away_from_axis);
  expect_closed_ring(patch, 4);
  EXPECT_NEAR(testing::area_of(patch), 4 * std::sqrt(2), kRounding);
  for (const Triangle& t : patch.triangles) {
    const Vec3 &p = patch.positions[t[0]], &q = patch.positions[t[1]], &r = patch.positions[t[2]];
    EXPECT_GT((q - p).cross(r - p).dot(away_from_axis(p + q + r)), 0);
  }
}

// The second square starts at another corner: the same prism.
TEST(ZipRings, FindsTheTwist) {
  std::vector<Vec3> turned = testing::ring(4, 1, 1);
  std::rotate(turned.begin(), turned.begin() + 2, turned.end());
  const TrianglePatch patch = zipped(testing::ring(4), turned, nullptr);
  expect_closed_ring(patch, 4);
  EXPECT_NEAR(testing::area_of(patch), 4 * std::sqrt(2), kRounding);
}

// Law: any two wobbling rings.
TEST(ZipRings, EachEdgeOnceInTheRightDirection) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> wobble(-0.3, 0.3);
  for (const auto& [n, m] : {std::pair{3, 3}, {3, 17}, {7, 11}, {24, 5}, {30, 30}}) {
    std::vector<Vec3> a = testing::ring(n), c = testing::ring(m, 0.7, 0.5, 1);
    for (auto* points : {&a, &c})
      for (Vec3& p : *points) p += Vec3(wobble(random), wobble(random), wobble(random));
    expect_closed_ring(zipped(a, c, away_from_axis), a.size());
    expect_closed_ring(zipped(a, c, nullptr), a.size());
  }
}

// One loop hardly has an extent: still a ring, no fan about one of its vertices.
TEST(ZipRings, TinyAgainstLarge) {
  for (const double radius : {1e-2, 1e-5, 1e-8})
    expect_closed_ring(zipped(testing::ring(20), testing::ring(5, radius, 0.5), nullptr), 20);
}

TEST(FillLoop, PlanarPolygonAreaAndBorder) {
  for (const int n : {3, 4, 7, 40}) {
    const std::vector<Vec3> loop = testing::ring(n, 2);
    const TrianglePatch patch{loop, fill_loop(loop), loop.size()};
    EXPECT_EQ(patch.triangles.size(), loop.size() - 2);
    EXPECT_NEAR(testing::area_of(patch), 0.5 * n * 4 * std::sin(2 * std::numbers::pi / n), kRounding);
    std::vector<std::int32_t> whole;
    for (int i = 0; i < n; ++i) whole.push_back(i);
    EXPECT_THAT(boundary_loops(patch.triangles), ::testing::ElementsAre(whole));
  }
}

// An arrow head, concave at (0, 0): split there it has area 3 + 3; along the other diagonal 8 + 2.
TEST(FillLoop, ConcaveLoopIsSplitAtItsInnerCorner) {
  const std::vector<Vec3> arrow = {{0, 3, 0}, {-2, -1, 0}, {0, 0, 0}, {2, -1, 0}};
  const TrianglePatch patch{arrow, fill_loop(arrow), 4};
  EXPECT_NEAR(testing::area_of(patch), 6, kRounding);
  EXPECT_TRUE(testing::half_edge_uses(patch.triangles).contains({0, 2}));
}

TEST(FillLoop, LongLoopsByAFan) {
  const std::vector<Vec3> loop = testing::ring(300);
  const TrianglePatch patch{loop, fill_loop(loop), loop.size()};
  EXPECT_EQ(patch.triangles.size(), 298u);
  EXPECT_THAT(patch.triangles, Contains(Triangle{0, 150, 151}));
  EXPECT_NEAR(testing::area_of(patch), 150 * std::sin(2 * std::numbers::pi / 300), kRounding);
}

}  // namespace
}  // namespace skinforge
