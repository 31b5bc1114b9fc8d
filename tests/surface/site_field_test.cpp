#include "surface/site_field.h"

#include <gtest/gtest.h>

#include "surface/junction_scene.h"

namespace skinforge {
namespace {

constexpr double kFloat = 1e-5;  // distances of a few units are kept in floats

// Both tubes change between x = -1 and 1; there the region is, as wide as the thicker of them.
TEST(AffectedRegion, OfTwoTubes) {
  const auto scene = testing::tubes_end_to_end();
  const Eigen::AlignedBox3d box = affected_region(scene.solids);
  EXPECT_NEAR(box.min().x(), -1, kFloat);
  EXPECT_NEAR(box.max().x(), 1, kFloat);
  EXPECT_NEAR(box.max().y(), 1, kFloat);
}

// By hand: the line of presence 1/2 of the thin tube is a regular 12-gon, 24 * 0.8 * sin(15 degrees) around;
// 8 pi voxels of it, which is less than 0.8 of a mean edge.
TEST(FieldLattice, VoxelFromTheLesserGirth) {
  const auto scene = testing::tubes_end_to_end();
  const Lattice lattice = field_lattice(scene.solids, {});
  EXPECT_NEAR(lattice.voxel, 24 * 0.8 * std::sin(std::numbers::pi / 12) / (8 * std::numbers::pi), 1e-9);
  for (int axis = 0; axis < 3; ++axis) {
    const double index = lattice.origin[axis] / lattice.voxel;
    EXPECT_NEAR(index, std::round(index), 1e-9);  // planes at multiples of the voxel
  }
  const Eigen::AlignedBox3d region = affected_region(scene.solids);
  const Vec3 margin = Vec3::Constant(5 * lattice.voxel * (1 - 1e-9));
  EXPECT_TRUE(lattice.box().contains(Eigen::AlignedBox3d(region.min() - margin, region.max() + margin)));
}

TEST(FieldLattice, LargerVoxelWhereThereWouldBeTooManyPoints) {
  const auto scene = testing::tubes_end_to_end();
  const Lattice lattice = field_lattice(scene.solids, {.max_points = 1000});
  EXPECT_GT(lattice.voxel, field_lattice(scene.solids, {}).voxel);
  EXPECT_LT(lattice.count(), 8000u);
}

// By hand, on the axis: before the cut the host alone decides, behind it the donor, half way their mean. A
// regular n-gon of radius r is r * cos(pi / n) away from its centre.
TEST(BuildSiteField, FollowsPresenceAlongTheAxis) {
  const auto scene = testing::tubes_end_to_end();
  const double host = std::cos(std::numbers::pi / 14), donor = 0.8 * std::cos(std::numbers::pi / 12);
  EXPECT_NEAR(blended_distance(scene.solids, scene.field, {-1.5, 0, 0}), -host, kFloat);
  EXPECT_NEAR(blended_distance(scene.solids, scene.field, {1.5, 0, 0}), -donor, kFloat);
  EXPECT_NEAR(blended_distance(scene.solids, scene.field, {0, 0, 0}), -0.5 * (host + donor), 1e-3);
}

// The lattice holds what exact queries answer, near the surface; farther away nearly that, since sources are
// sampled more coarsely there. On its faces directions are one-sided.
TEST(BuildSiteField, LatticeAgreesWithExactQueries) {
  for (const auto& scene : {testing::tubes_end_to_end(), testing::tube_on_a_box()}) {
    const Lattice& lattice = scene.field.distance.lattice;
    ASSERT_EQ(scene.field.distance.values.size(), lattice.count());
    for (int k = 1; k + 1 < lattice.size[2]; k += 3)
      for (int j = 1; j + 1 < lattice.size[1]; j += 3)
        for (int i = 1; i + 1 < lattice.size[0]; i += 3) {
          const double value = scene.field.distance.values[lattice.index(i, j, k)];
          EXPECT_NEAR(value,
                      blended_distance(scene.solids, scene.field, lattice.point(i, j, k)) / lattice.voxel,
                      std::abs(value) < 5 ? 1e-3 : 0.26);
        }
  }
}

// A union: away from the seam the nearer surface, inside either solid negative.
TEST(BuildSiteField, AddedPartIsUnited) {
  const auto scene = testing::tube_on_a_box();
  EXPECT_NEAR(blended_distance(scene.solids, scene.field, {2.5, 1.9, 1.9}), 0.5, kFloat);
  EXPECT_LT(blended_distance(scene.solids, scene.field, {1.5, 0, 0}), -0.4);
  EXPECT_LT(blended_distance(scene.solids, scene.field, {4, 0.11, -0.07}), -0.5);
}

TEST(BuildSiteField, EmptyWhereNothingIsAffected) {
  EXPECT_TRUE(build_site_field({}, {}).is_empty());
  std::vector<FusionSolid> whole;
  const PolygonMesh cube = testing::quad_cube();
  whole.push_back(fusion_solid(cube, {SourceId(0), true, false, std::vector<double>(8, 1), FaceSet(6, 1)}));
  EXPECT_TRUE(affected_region(whole).isEmpty());
  EXPECT_TRUE(build_site_field(whole, {}).is_empty());
}

}  // namespace
}  // namespace skinforge
