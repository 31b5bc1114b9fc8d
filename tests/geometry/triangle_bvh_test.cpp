#include "geometry/triangle_bvh.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>
#include <random>

#include "geometry/triangle_math.h"
#include "testing/shapes.h"

namespace skinforge {
namespace {

using testing::Soup;

constexpr double kRounding = 1e-12;  // distances near 1 in double
constexpr double kExpansion = 5e-3;  // error of the far field at accuracy 2; Barill 2018 and our own 3e-3

TriangleBvh bvh_of(const Soup& s) {
  return TriangleBvh(s.positions, s.triangles);
}

TriangleCorners corners(const Soup& s, std::size_t t) {
  return {s.positions[s.triangles[t][0]], s.positions[s.triangles[t][1]], s.positions[s.triangles[t][2]]};
}

double brute_force_distance(const Soup& s, const Vec3& p) {
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < s.triangles.size(); ++t)
    best = std::min(best, (p - interpolate(corners(s, t), closest_barycentric(p, corners(s, t)))).norm());
  return best;
}

double brute_force_winding(const Soup& s, const Vec3& p) {
  double sum = 0;
  for (std::size_t t = 0; t < s.triangles.size(); ++t) {
    const TriangleCorners one = corners(s, t);
    sum += solid_angle(p, std::span(&one, 1));
  }
  return sum / (4 * std::numbers::pi);
}

double brute_force_hit(const Soup& s, const Vec3& origin, const Vec3& direction) {
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < s.triangles.size(); ++t)
    if (const auto hit = ray_parameter(origin, direction, corners(s, t))) best = std::min(best, *hit);
  return best;
}

class Points {
 public:
  explicit Points(unsigned seed) : random_(seed) {}
  Vec3 in_box(double low, double high) {
    std::uniform_real_distribution<double> number(low, high);
    return {number(random_), number(random_), number(random_)};
  }
  std::mt19937& engine() { return random_; }

 private:
  std::mt19937 random_;
};

Soup moved(const Soup& s, const Affine3& map) {
  Soup result = s;
  for (Vec3& p : result.positions) p = map * p;
  return result;
}

Affine3 some_motion() {
  Affine3 m = Affine3::Identity();
  m.linear() = Eigen::AngleAxisd(1.1, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  m.translation() = Vec3(3, -2, 5);
  return m;
}

// Unit cube: above the top face, off an edge, off a corner, inside.
TEST(TriangleBvh, ClosestOnCubeByHand) {
  const TriangleBvh bvh = bvh_of(testing::cube_soup());
  EXPECT_NEAR(bvh.closest({0.25, 0.5, 3}).distance, 2, kRounding);
  EXPECT_NEAR(bvh.closest({0.5, 4, 5}).distance, 5, kRounding);
  EXPECT_NEAR(bvh.closest({-2, -3, -6}).distance, 7, kRounding);
  const ClosestPoint inside = bvh.closest({0.5, 0.25, 0.125});
  EXPECT_NEAR(inside.distance, 0.125, kRounding);
  EXPECT_TRUE(inside.point.isApprox(Vec3(0.5, 0.25, 0), kRounding));
  EXPECT_EQ(bvh.closest({-2, -3, -6}).triangle, 0);  // a tie of all triangles at the corner
}

TEST(TriangleBvh, ClosestRespectsTheLimit) {
  const TriangleBvh bvh = bvh_of(testing::cube_soup());
  EXPECT_EQ(bvh.closest({0.25, 0.5, 3}, 1.999).triangle, -1);
  EXPECT_GE(bvh.closest({0.25, 0.5, 3}, 2).triangle, 0);  // the limit itself is within
}

TEST(TriangleBvh, ClosestMatchesBruteForce) {
  Points points(7);
  for (const int count : {1, 3, 4, 5, 17, 300}) {
    const Soup soup = testing::random_soup(points.engine(), count);
    const TriangleBvh bvh = bvh_of(soup);
    for (int i = 0; i < 200; ++i) {
      const Vec3 p = points.in_box(-1, 2);
      const ClosestPoint c = bvh.closest(p);
      ASSERT_NEAR(c.distance, brute_force_distance(soup, p), kRounding);
      EXPECT_NEAR((p - c.point).norm(), c.distance, kRounding);
      EXPECT_TRUE(interpolate(corners(soup, c.triangle), c.barycentric).isApprox(c.point, kRounding));
    }
  }
}

TEST(TriangleBvh, AnyHintGivesTheSameAnswer) {
  Points points(8);
  const Soup knot = testing::torus_knot_soup(40, 8);
  const TriangleBvh bvh = bvh_of(knot);
  for (int i = 0; i < 200; ++i) {
    const Vec3 p = points.in_box(-3.5, 3.5);
    const ClosestPoint plain = bvh.closest(p), hinted = bvh.closest_from_hint(p, (37 * i) % 640);
    EXPECT_EQ(plain.triangle, hinted.triangle);
    EXPECT_EQ(plain.point, hinted.point);
    EXPECT_EQ(plain.distance, hinted.distance);
  }
}

TEST(TriangleBvh, WindingOfClosedSurfaces) {
  const TriangleBvh cube = bvh_of(testing::cube_soup());
  EXPECT_NEAR(cube.winding_number({0.5, 0.5, 0.5}), 1, kRounding);
  EXPECT_NEAR(cube.winding_number({0.5, 0.5, 0.999}), 1, kRounding);
  EXPECT_NEAR(cube.winding_number({0.5, 0.5, 1.001}), 0, kRounding);
  const TriangleBvh sphere = bvh_of(testing::sphere_soup(20));
  Points points(3);
  for (int i = 0; i < 500; ++i) {
    const Vec3 p = points.in_box(-1.5, 1.5);
    if (std::abs(p.norm() - 1) < 0.02) continue;
    EXPECT_NEAR(sphere.winding_number(p), p.norm() < 1 ? 1 : 0, kExpansion);
  }
}

TEST(TriangleBvh, WindingOfFlippedAndNestedSurfaces) {
  Soup soup = testing::sphere_soup(12);
  for (auto& t : soup.triangles) std::swap(t[0], t[1]);
  EXPECT_NEAR(bvh_of(soup).winding_number(Vec3(0.2, 0.1, 0)), -1, kExpansion);
  Soup nested = testing::sphere_soup(12);
  const Soup inner = testing::sphere_soup(12, 0.5);
  const int shift = static_cast<int>(nested.positions.size());
  nested.positions.insert(nested.positions.end(), inner.positions.begin(), inner.positions.end());
  for (const auto& t : inner.triangles)
    nested.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
  EXPECT_NEAR(bvh_of(nested).winding_number(Vec3::Zero()), 2, kExpansion);
  EXPECT_NEAR(bvh_of(nested).winding_number(Vec3(0.75, 0, 0)), 1, kExpansion);
}

// The cube without its top: seen from the centre five sixths remain; in the opening it fades through one
// half.
TEST(TriangleBvh, WindingOverAHole) {
  Soup soup = testing::cube_soup();
  soup.triangles.erase(soup.triangles.begin() + 2, soup.triangles.begin() + 4);
  const TriangleBvh bvh = bvh_of(soup);
  EXPECT_NEAR(bvh.winding_number({0.5, 0.5, 0.5}), 5.0 / 6, kRounding);
  EXPECT_NEAR(bvh.winding_number({0.5, 0.5, 1}), 0.5, kRounding);
  EXPECT_LT(bvh.winding_number({0.5, 0.5, 1.5}), 0.5);
}

TEST(TriangleBvh, WindingMatchesTheExactSum) {
  Points points(11);
  const Soup knot = testing::torus_knot_soup(120, 12);
  const TriangleBvh bvh = bvh_of(knot);
  int wrong_side = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 p = points.in_box(-3.5, 3.5);
    const double exact = brute_force_winding(knot, p);
    ASSERT_NEAR(bvh.winding_number(p), exact, kExpansion);
    wrong_side += (bvh.winding_number(p) > 0.5) != (exact > 0.5);
  }
  EXPECT_EQ(wrong_side, 0);
  const Soup open = testing::random_soup(points.engine(), 200);
  const TriangleBvh open_bvh = bvh_of(open);
  for (int i = 0; i < 300; ++i) {
    const Vec3 p = points.in_box(-1, 2);
    EXPECT_NEAR(open_bvh.winding_number(p), brute_force_winding(open, p), 0.05);  // 200 sheets, errors add up
  }
}

TEST(TriangleBvh, RigidMotionChangesNothing) {
  const Soup soup = testing::torus_knot_soup(60, 8);
  const Affine3 motion = some_motion();
  const TriangleBvh here = bvh_of(soup), there = bvh_of(moved(soup, motion));
  Points points(5);
  for (int i = 0; i < 300; ++i) {
    const Vec3 p = points.in_box(-3.5, 3.5);
    EXPECT_NEAR(here.closest(p).distance, there.closest(motion * p).distance, 10 * kRounding);
    EXPECT_NEAR(here.winding_number(p), there.winding_number(motion * p), 2 * kExpansion);
  }
}

// Scaling by a power of two is exact in double, so every answer scales to the last bit.
TEST(TriangleBvh, ScaleIsExact) {
  const Soup soup = testing::torus_knot_soup(40, 8);
  Affine3 scale = Affine3::Identity();
  scale.linear() *= 0.0078125;
  const TriangleBvh here = bvh_of(soup), there = bvh_of(moved(soup, scale));
  Points points(6);
  for (int i = 0; i < 300; ++i) {
    const Vec3 p = points.in_box(-3.5, 3.5);
    const ClosestPoint a = here.closest(p), b = there.closest(scale * p);
    EXPECT_EQ(a.triangle, b.triangle);
    EXPECT_EQ(a.distance * 0.0078125, b.distance);
    EXPECT_EQ(here.winding_number(p), there.winding_number(scale * p));
  }
}

TEST(TriangleBvh, FirstHitByHandAndAgainstBruteForce) {
  const TriangleBvh cube = bvh_of(testing::cube_soup());
  EXPECT_NEAR(cube.first_hit({0.3, 0.6, 5}, {0, 0, -2}).distance, 2, kRounding);
  EXPECT_NEAR(cube.first_hit({0.3, 0.6, 0.5}, {0, 0, -2}).distance, 0.25, kRounding);  // from inside
  EXPECT_EQ(cube.first_hit({0.3, 0.6, 5}, {0, 0, 1}).triangle, -1);
  EXPECT_EQ(cube.first_hit({0.3, 0.6, 5}, {0, 0, -2}, 1.9).triangle, -1);
  EXPECT_EQ(cube.first_hit({0, 0, 5}, {0, 0, -1}).distance, 4);  // along an edge of the boxes
  Points points(13);
  const Soup soup = testing::random_soup(points.engine(), 150);
  const TriangleBvh bvh = bvh_of(soup);
  for (int i = 0; i < 400; ++i) {
    const Vec3 origin = points.in_box(-1, 2), direction = points.in_box(-1, 1);
    const RayHit hit = bvh.first_hit(origin, direction);
    const double expected = brute_force_hit(soup, origin, direction);
    ASSERT_EQ(hit.triangle >= 0, std::isfinite(expected));
    if (hit.triangle < 0) continue;
    EXPECT_EQ(hit.distance, expected);
  }
}

TEST(TriangleBvh, OverlappingFindsExactlyTheBoxes) {
  Points points(17);
  const Soup soup = testing::random_soup(points.engine(), 120);
  const TriangleBvh bvh = bvh_of(soup);
  for (int i = 0; i < 50; ++i) {
    const Vec3 a = points.in_box(0, 1), b = points.in_box(0, 0.2);
    const Eigen::AlignedBox3d wanted(a, a + b);
    std::vector<std::int32_t> expected;
    for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
      Eigen::AlignedBox3d box;
      for (const Vec3& corner : corners(soup, t)) box.extend(corner);
      if (box.intersects(wanted)) expected.push_back(static_cast<std::int32_t>(t));
    }
    EXPECT_EQ(bvh.overlapping(a, a + b), expected);
  }
}

TEST(TriangleBvh, EmptyFindsNothing) {
  const TriangleBvh bvh({}, {});
  EXPECT_EQ(bvh.closest({1, 2, 3}).triangle, -1);
  EXPECT_EQ(bvh.winding_number({1, 2, 3}), 0);
  EXPECT_EQ(bvh.first_hit({0, 0, 0}, {1, 0, 0}).triangle, -1);
  EXPECT_TRUE(bvh.overlapping({-1, -1, -1}, {1, 1, 1}).empty());
}

// Triangles without area: found by closest, silent in the winding number, even for points on them.
TEST(TriangleBvh, DegenerateTriangles) {
  Soup soup = testing::cube_soup();
  const TriangleBvh clean = bvh_of(soup);
  soup.positions.push_back({2, 0, 0});
  soup.positions.push_back({3, 0, 0});
  soup.positions.push_back({4, 0, 0});
  soup.triangles.push_back({8, 9, 10});
  for (int i = 0; i < 20; ++i) soup.triangles.push_back({8, 8, 8});
  const TriangleBvh bvh = bvh_of(soup);
  EXPECT_NEAR(bvh.closest({3.5, 2, 0}).distance, 2, kRounding);
  EXPECT_EQ(bvh.closest({2, 0.5, 0.5}).triangle, 12);
  EXPECT_NEAR(bvh.winding_number({0.5, 0.5, 0.5}), 1, kRounding);
  for (const Vec3& p : {Vec3(3, 0, 0), Vec3(2, 0, 0), Vec3(3.5, 0.01, 0)})
    EXPECT_NEAR(bvh.winding_number(p), clean.winding_number(p), kExpansion);
}

}  // namespace
}  // namespace skinforge
