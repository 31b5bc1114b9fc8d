#include "field/source_distance.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/parallel.h"
#include "testing/fields.h"
#include "testing/shapes.h"

namespace skinforge {
namespace {

using testing::Soup;

constexpr double kFloat = 1e-6;  // stored in float, of size 1

// Presence that rises along x from 0 at -1 to 1 at 1.
std::vector<double> ramp(const Soup& s) {
  std::vector<double> presence;
  for (const Vec3& p : s.positions) presence.push_back(std::clamp(p.x() / 2 + 0.5, 0.0, 1.0));
  return presence;
}

SourceSamples sample(const Lattice& lattice, const Soup& s, double band) {
  return sample_source(lattice, TriangleBvh(s.positions, s.triangles), s.triangles, ramp(s), band);
}

// Cube [0, 2]^3 by hand: inside, outside, beyond the band.
TEST(SampleSource, CubeByHand) {
  const Lattice lattice{.origin = Vec3(-4, 1, 1), .voxel = 0.5, .size = {15, 1, 1}};
  const SourceSamples samples = sample(lattice, testing::cube_soup(2), 2.5);
  const std::vector<float> expected = {2.5f, 2.5f, 2.5f, 2.5f, 2.5f, 2.5f, 2, 1, 0, -1, -2, -1, 0, 1, 2};
  ASSERT_EQ(samples.distance.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(samples.distance[i], expected[i], kFloat);
  EXPECT_NEAR(samples.presence[7], 0.5, kFloat);  // nearest point x = 0
  EXPECT_NEAR(samples.presence[13], 1, kFloat);   // nearest point x = 2
}

// What the blocks answer equals what each point would be told.
TEST(SampleSource, MatchesQueriesOfEveryPoint) {
  const Soup knot = testing::torus_knot_soup(80, 8);
  const TriangleBvh bvh(knot.positions, knot.triangles);
  const std::vector<double> presence = ramp(knot);
  Lattice lattice = testing::centred_lattice(37, 3.7);
  lattice.size = {37, 30, 21};
  const double band = 4;
  const SourceSamples samples = sample_source(lattice, bvh, knot.triangles, presence, band);
  for (int k = 0; k < lattice.size[2]; ++k)
    for (int j = 0; j < lattice.size[1]; ++j)
      for (int i = 0; i < lattice.size[0]; ++i) {
        const Vec3 p = lattice.point(i, j, k);
        const ClosestPoint nearest = bvh.closest(p);
        const double length = std::min(nearest.distance / lattice.voxel, band);
        const double signed_length = bvh.winding_number(p) > 0.5 ? -length : length;
        ASSERT_NEAR(samples.distance[lattice.index(i, j, k)], signed_length, kFloat);
        if (nearest.distance > band * lattice.voxel) continue;
        double expected = 0;
        for (int c = 0; c < 3; ++c)
          expected += nearest.barycentric[c] * presence[knot.triangles[nearest.triangle][c]];
        ASSERT_NEAR(samples.presence[lattice.index(i, j, k)], expected, 10 * kFloat);
      }
}

// Beyond a few voxels from the surface the corners of larger cubes tell: outside of a ball the distance is
// off by at most a sixth of a voxel at 6 voxels and a quarter at 16 (the error of a line
// between two points of a cone), inside by more where directions turn around, but only farther than 12 voxels
// from it.
TEST(SampleSource, FarFromTheSurfaceItIsNearlyExact) {
  const Soup ball = testing::sphere_soup(40);
  const TriangleBvh bvh(ball.positions, ball.triangles);
  const Lattice lattice = testing::centred_lattice(81, 2.4);
  const SourceSamples samples = sample_source(lattice, bvh, ball.triangles, ramp(ball), 30);
  double near = 0, outside = 0, inside = 0;  // largest errors, voxels
  for (int k = 0; k < 81; k += 3)
    for (int j = 0; j < 81; ++j)
      for (int i = 0; i < 81; ++i) {
        const Vec3 p = lattice.point(i, j, k);
        const double distance = bvh.closest(p).distance / lattice.voxel;
        const double found = samples.distance[lattice.index(i, j, k)];
        const double error = std::abs(std::abs(found) - std::min(distance, 30.0));
        double& largest = distance < 6 ? near : (p.norm() > 1 ? outside : inside);
        largest = std::max(largest, error);
        if (p.norm() < 1 && distance < 12) near = std::max(near, error);
      }
  EXPECT_LT(near, 1e-4);
  EXPECT_LT(outside, 0.26);
  EXPECT_LT(inside, 2.0);
}

// Law: a mirrored solid has mirrored samples.
TEST(SampleSource, MirroredSolidsHaveMirroredSamples) {
  Soup shape = testing::torus_knot_soup(40, 8);
  Soup mirrored = shape;
  for (Vec3& p : mirrored.positions) p.x() = -p.x();
  for (auto& t : mirrored.triangles) std::swap(t[1], t[2]);
  const Lattice lattice{.origin = Vec3(-3, -3, -2), .voxel = 0.125, .size = {49, 49, 33}};
  const std::vector<double> presence(shape.positions.size(), 0.5);
  const SourceSamples one =
      sample_source(lattice, TriangleBvh(shape.positions, shape.triangles), shape.triangles, presence, 30);
  const SourceSamples other = sample_source(lattice, TriangleBvh(mirrored.positions, mirrored.triangles),
                                            mirrored.triangles, presence, 30);
  for (int k = 0; k < 33; ++k)
    for (int j = 0; j < 49; ++j)
      for (int i = 0; i < 49; ++i)
        ASSERT_NEAR(one.distance[lattice.index(i, j, k)], other.distance[lattice.index(48 - i, j, k)],
                    kFloat);
}

// A sphere with a hole in its top: still a solid whose lid is where the winding number passes one half.
TEST(SampleSource, OpenMeshKeepsItsInside) {
  Soup sphere = testing::sphere_soup(16);
  std::erase_if(sphere.triangles, [&](const auto& t) {
    return std::any_of(t.begin(), t.end(), [&](int v) { return sphere.positions[v].y() > 0.85; });
  });
  const TriangleBvh bvh(sphere.positions, sphere.triangles);
  const Lattice lattice = testing::centred_lattice(33, 1.6);
  const SourceSamples samples = sample_source(lattice, bvh, sphere.triangles, ramp(sphere), 0.4);
  int inside = 0;
  for (int k = 0; k < 33; ++k)
    for (int j = 0; j < 33; ++j)
      for (int i = 0; i < 33; ++i) {
        const Vec3 p = lattice.point(i, j, k);
        const bool is_inside = samples.distance[lattice.index(i, j, k)] < 0;
        inside += is_inside;
        ASSERT_EQ(is_inside, bvh.winding_number(p) > 0.5) << p.transpose();
      }
  EXPECT_GT(inside * std::pow(lattice.voxel, 3), 3.6);  // the full ball has 4.19
}

// Law: few points are asked for their winding numbers, but each side is what that would say. Closed: a knot
// and a ball that run into each other, and a ball in a ball. Open: the same with every eleventh triangle
// lost.
TEST(SampleSource, SidesAreThoseOfTheWindingNumber) {
  Soup closed = testing::torus_knot_soup(60, 8);
  for (const double radius : {0.8, 1.6}) {
    const Soup ball = testing::sphere_soup(12, radius, Vec3(1, 0, 0));
    const auto first = static_cast<std::int32_t>(closed.positions.size());
    closed.positions.insert(closed.positions.end(), ball.positions.begin(), ball.positions.end());
    for (const auto& t : ball.triangles)
      closed.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
  Soup open = closed;
  open.triangles.clear();
  for (std::size_t t = 0; t < closed.triangles.size(); ++t)
    if (t % 11 != 0) open.triangles.push_back(closed.triangles[t]);
  for (const Soup& soup : {closed, open}) {
    const TriangleBvh bvh(soup.positions, soup.triangles);
    const Lattice lattice = testing::centred_lattice(61, 3.3);
    const SourceSamples samples = sample_source(lattice, bvh, soup.triangles, ramp(soup), 30);
    std::size_t wrong = 0;
    for (int k = 0; k < 61; ++k)
      for (int j = 0; j < 61; ++j)
        for (int i = 0; i < 61; ++i) {
          const bool is_inside = bvh.winding_number(lattice.point(i, j, k)) > 0.5;
          const float distance = samples.distance[lattice.index(i, j, k)];
          wrong += std::abs(distance) < 5 && (distance < 0) != is_inside;
        }
    EXPECT_EQ(wrong, 0u);
  }
}

// Law: where less is asked for, points nearer to the surface than that still get their own distance.
TEST(SampleSource, AsksAsFarAsItIsTold) {
  const Soup ball = testing::sphere_soup(40);
  const TriangleBvh bvh(ball.positions, ball.triangles);
  const Lattice lattice = testing::centred_lattice(61, 2.4);
  const SamplingReach reach{.pairs_outside = 4, .pairs_inside = 3, .fours_outside = 8, .fours_inside = 7};
  const SourceSamples samples = sample_source(lattice, bvh, ball.triangles, ramp(ball), 30, reach);
  double near = 0, far = 0;  // largest errors, voxels
  for (int k = 0; k < 61; ++k)
    for (int j = 0; j < 61; ++j)
      for (int i = 0; i < 61; ++i) {
        const Vec3 p = lattice.point(i, j, k);
        const double distance = bvh.closest(p).distance / lattice.voxel, nearest = p.norm() > 1 ? 4 : 3;
        const double error = std::abs(std::abs(samples.distance[lattice.index(i, j, k)]) - distance);
        double& largest = distance < nearest ? near : far;
        largest = std::max(largest, error);
      }
  EXPECT_LT(near, 1e-4);
  EXPECT_GT(far, 0.05);
}

TEST(SampleSource, SameBitsForAnyNumberOfThreads) {
  const Soup knot = testing::torus_knot_soup(60, 8);
  const Lattice lattice = testing::centred_lattice(50, 3.7);
  set_thread_limit(1);
  const SourceSamples one = sample(lattice, knot, 0.5);
  set_thread_limit(4);
  const SourceSamples four = sample(lattice, knot, 0.5);
  EXPECT_EQ(one.distance, four.distance);
  EXPECT_EQ(one.presence, four.presence);
}

TEST(SampleSource, NoTrianglesAndNoPoints) {
  const Lattice lattice = testing::centred_lattice(3, 1);
  const SourceSamples samples = sample_source(lattice, TriangleBvh({}, {}), {}, {}, 0.5);
  EXPECT_EQ(samples.distance, std::vector<float>(27, 0.5f));
  EXPECT_EQ(samples.presence, std::vector<float>(27, 0.0f));
  EXPECT_TRUE(sample(Lattice{}, testing::cube_soup(), 1).distance.empty());
}

}  // namespace
}  // namespace skinforge
