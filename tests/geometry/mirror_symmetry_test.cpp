#include "geometry/mirror_symmetry.h"

#include <gtest/gtest.h>

#include <random>

#include "testing/assets.h"
#include "testing/gltf_mesh.h"

namespace skinforge {
namespace {

// Points on both sides of x = 3 and some on it; no other symmetry.
std::vector<Vec3> symmetric_cloud() {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Vec3> points;
  for (int i = 0; i < 40; ++i) {
    const Vec3 p(1 + unit(random), 2 * unit(random), 5 * unit(random));
    points.push_back(Vec3(3, 0, 0) + p);
    points.push_back(Vec3(3 - p.x(), p.y(), p.z()));
  }
  for (int i = 0; i < 5; ++i) points.emplace_back(3, unit(random), 5 * unit(random));
  return points;
}

TEST(FindMirrorSymmetry, PlaneAndPartnersByHand) {
  const auto mirror = find_mirror_symmetry(symmetric_cloud());
  ASSERT_TRUE(mirror);
  EXPECT_EQ(mirror->plane.normal, Vec3::UnitX());
  EXPECT_NEAR(mirror->plane.offset, 3, 0.01);
  EXPECT_EQ(mirror->matched, 1);
  EXPECT_EQ(mirror->partner[0], VertexId(1));
  EXPECT_EQ(mirror->partner[7], VertexId(6));
  EXPECT_EQ(mirror->partner[81], VertexId(81));  // on the plane
}

// Turned by a rotation, the plane is found across a principal axis, with the same partners.
TEST(FindMirrorSymmetry, RotatedCloud) {
  const std::vector<Vec3> points = symmetric_cloud();
  const Mat3 turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  std::vector<Vec3> turned;
  for (const Vec3& p : points) turned.push_back(turn * p);
  const auto mirror = find_mirror_symmetry(turned);
  ASSERT_TRUE(mirror);
  EXPECT_NEAR(std::abs(mirror->plane.normal.dot(turn * Vec3::UnitX())), 1, 1e-6);
  EXPECT_EQ(mirror->partner, find_mirror_symmetry(points)->partner);
}

TEST(FindMirrorSymmetry, FewStrayPointsAreAllowedManyAreNot) {
  std::vector<Vec3> points = symmetric_cloud();
  points.emplace_back(3.7, 0.3, 0.2);
  const auto mirror = find_mirror_symmetry(points, {.tolerance = 1e-3, .least_share = 0.98});
  ASSERT_TRUE(mirror);
  EXPECT_FALSE(mirror->partner.back().is_valid());
  for (int i = 0; i < 9; ++i) points.emplace_back(3.5 + 0.1 * i, 0.3 + 0.02 * i * i, 0.2 * i);
  EXPECT_FALSE(find_mirror_symmetry(points));
}

TEST(FindMirrorSymmetry, TooFewPoints) {
  EXPECT_FALSE(find_mirror_symmetry({}));
  EXPECT_FALSE(find_mirror_symmetry(std::vector<Vec3>{{1, 2, 3}}));
  EXPECT_FALSE(find_mirror_symmetry(std::vector<Vec3>(5, Vec3(1, 2, 3))));
}

// The T-rex is modelled by halves across x = 0 in its own space; partners undo each other.
TEST(FindMirrorSymmetry, RealCharacter) {
  SKINFORGE_NEEDS_SHARED();
  const PolygonMesh mesh = testing::GlbMesh::read(testing::shared_file("assets/quaternius_trex/trex.glb"));
  const auto mirror = find_mirror_symmetry(mesh.positions);
  ASSERT_TRUE(mirror);
  EXPECT_GE(mirror->matched, 0.98);
  EXPECT_NEAR(mirror->plane.normal.x(), 1, 1e-6);
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    const VertexId u = mirror->partner[v];
    if (!u.is_valid()) continue;
    EXPECT_EQ(mirror->partner[u.index()], VertexId(v));
    EXPECT_LT((mirror->plane.mirrored(mesh.positions[v]) - mesh.positions[u.index()]).norm(),
              1e-3 * mesh.diagonal());
  }
}

}  // namespace
}  // namespace skinforge
