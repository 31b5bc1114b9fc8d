#include "skinning/linear_blend.h"

#include <gtest/gtest.h>

#include <random>

#include "base/parallel.h"

namespace skinforge {
namespace {

constexpr double kRounding = 1e-12;  // a few dozen products of numbers near 1 in double

Influence influence(int joint, double weight) {
  return {JointId(joint), weight};
}

SkinWeights rows(const std::vector<std::vector<Influence>>& list) {
  SkinWeights weights;
  for (const auto& row : list) weights.push_row(row);
  return weights;
}

Affine3 turn(double angle_deg, const Vec3& axis, const Vec3& shift) {
  Affine3 m;
  m.linear() = Eigen::AngleAxisd(radians(angle_deg), axis.normalized()).toRotationMatrix();
  m.translation() = shift;
  return m;
}

struct Cloud {
  std::vector<Vec3> positions;
  std::vector<Vec3> normals;
  std::vector<VertexId> corners;
  SkinWeights weights;
};

// Random points with four influences out of six joints, rows summing to 1; one corner a vertex.
Cloud random_cloud(std::size_t count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0.05, 1.0);
  Cloud cloud;
  for (std::size_t v = 0; v < count; ++v) {
    cloud.positions.emplace_back(unit(random), unit(random), unit(random));
    cloud.normals.push_back(Vec3(unit(random), -unit(random), unit(random)).normalized());
    cloud.corners.push_back(VertexId(v));
    std::vector<Influence> row;
    for (int i = 0; i < 4; ++i) row.push_back(influence((static_cast<int>(v) + i) % 6, unit(random)));
    cloud.weights.push_row(normalised_row(row));
  }
  return cloud;
}

// By hand: half of a quarter turn about z and half of the identity sends (1, 0, 0) to the middle of (1, 0, 0)
// and (0, 1, 0); a vertex that follows only the shifted joint moves by the shift.
TEST(LinearBlend, MixesMatricesByWeight) {
  const std::vector<Affine3> palette = {Affine3::Identity(), turn(90, Vec3::UnitZ(), Vec3::Zero()),
                                        turn(0, Vec3::UnitX(), Vec3(0, 2, 0))};
  const std::vector<Vec3> positions = {{1, 0, 0}, {3, 1, 0}, {5, 5, 5}};
  const auto weights = rows({{influence(0, 0.5), influence(1, 0.5)}, {influence(2, 1)}, {}});
  const auto posed = linear_blend(positions, weights, palette);
  EXPECT_LT((posed[0] - Vec3(0.5, 0.5, 0)).norm(), kRounding);
  EXPECT_LT((posed[1] - Vec3(3, 3, 0)).norm(), kRounding);
  EXPECT_EQ(posed[2], positions[2]) << "a vertex without influences stays";
}

// By hand: a joint that doubles x keeps the plane x + y = 0 facing (1, 2) / sqrt 5; a mirror in x turns (1,
// 0, 0) over.
TEST(LinearBlend, NormalsFollowTheInverseTranspose) {
  Affine3 wide = Affine3::Identity(), mirror = Affine3::Identity();
  wide.linear().diagonal() = Vec3(2, 1, 1);
  mirror.linear().diagonal() = Vec3(-1, 1, 1);
  const std::vector<Affine3> palette = {wide, mirror};
  const std::vector<Vec3> normals = {Vec3(1, 1, 0).normalized(), Vec3(1, 0, 0), Vec3(0, 0, 0)};
  const std::vector<VertexId> corners = {VertexId(0), VertexId(1), VertexId(1)};
  const auto turned =
      linear_blend_normals(normals, corners, rows({{influence(0, 1)}, {influence(1, 1)}}), palette);
  EXPECT_LT((turned[0] - Vec3(1, 2, 0).normalized()).norm(), kRounding);
  EXPECT_LT((turned[1] - Vec3(-1, 0, 0)).norm(), kRounding);
  EXPECT_EQ(turned[2], Vec3(0, 0, 0));
}

TEST(LinearBlend, IdentityPaletteGivesTheBindPose) {
  const Cloud cloud = random_cloud(500);
  const std::vector<Affine3> palette(6, Affine3::Identity());
  const auto posed = linear_blend(cloud.positions, cloud.weights, palette);
  const auto turned = linear_blend_normals(cloud.normals, cloud.corners, cloud.weights, palette);
  for (std::size_t v = 0; v < posed.size(); ++v) {
    EXPECT_LT((posed[v] - cloud.positions[v]).norm(), kRounding);
    EXPECT_LT((turned[v] - cloud.normals[v]).norm(), kRounding);
  }
}

// A rigid motion of the whole palette moves every vertex and normal by that motion.
TEST(LinearBlend, MovesRigidlyWithTheWholePalette) {
  const Cloud cloud = random_cloud(500);
  const Affine3 motion = turn(50, Vec3(1, 2, 3), Vec3(4, -5, 6));
  std::vector<Affine3> palette, moved_palette;
  for (int j = 0; j < 6; ++j) {
    palette.push_back(turn(15 * j, Vec3(j, 1, 0), Vec3(0.1 * j, 0, 0)));
    moved_palette.push_back(motion * palette.back());
  }
  const auto posed = linear_blend(cloud.positions, cloud.weights, palette);
  const auto moved = linear_blend(cloud.positions, cloud.weights, moved_palette);
  const auto normals = linear_blend_normals(cloud.normals, cloud.corners, cloud.weights, palette);
  const auto moved_normals = linear_blend_normals(cloud.normals, cloud.corners, cloud.weights, moved_palette);
  for (std::size_t v = 0; v < posed.size(); ++v) {
    EXPECT_LT((moved[v] - motion * posed[v]).norm(), 10 * kRounding);
    EXPECT_LT((moved_normals[v] - motion.linear() * normals[v]).norm(), 10 * kRounding);
  }
}

TEST(LinearBlend, SameBitsForAnyNumberOfThreads) {
  const Cloud cloud = random_cloud(10000);
  std::vector<Affine3> palette;
  for (int j = 0; j < 6; ++j) palette.push_back(turn(20 * j, Vec3(1, j, 2), Vec3(j, 0, 1)));
  set_thread_limit(1);
  const auto alone = linear_blend(cloud.positions, cloud.weights, palette);
  set_thread_limit(4);
  EXPECT_EQ(alone, linear_blend(cloud.positions, cloud.weights, palette));
}

TEST(LinearBlend, EmptyMeshIsFine) {
  EXPECT_TRUE(linear_blend({}, SkinWeights{}, {}).empty());
  EXPECT_TRUE(linear_blend_normals({}, {}, SkinWeights{}, {}).empty());
}

}  // namespace
}  // namespace skinforge
