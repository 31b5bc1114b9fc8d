#include <gtest/gtest.h>
#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "field/signed_distance.h"
#include "testing/fields.h"

namespace skinforge {
namespace {

DistanceField clamped_sphere() {
  Lattice lattice = testing::centred_lattice(41, 1.6);
  lattice.origin += Vec3(10, 20, 30);
  const auto value = [](const Vec3& p) { return std::clamp((p - Vec3(10, 20, 30)).norm() - 1, -0.3, 0.3); };
  return testing::sampled(lattice, value);
}

// What another tool would do: open the file, find the grid, read it in world space.
openvdb::FloatGrid::Ptr read_back(const Bytes& bytes) {
  openvdb::initialize();
  const std::string path = ::testing::TempDir() + "skinforge_distance.vdb";
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  openvdb::io::File file(path);
  file.open(false);
  auto grid = openvdb::gridPtrCast<openvdb::FloatGrid>(file.readGrid("distance"));
  file.close();
  std::filesystem::remove(path);
  return grid;
}

TEST(ToVdb, ReadersFindTheGridInItsPlace) {
  const DistanceField field = clamped_sphere();
  const auto grid = read_back(to_vdb(field));
  ASSERT_TRUE(grid);
  EXPECT_EQ(grid->getGridClass(), openvdb::GRID_LEVEL_SET);
  EXPECT_NEAR(grid->voxelSize().x(), field.lattice.voxel, 1e-15);
  EXPECT_FLOAT_EQ(grid->background(), 0.3f);
  const auto& lattice = field.lattice;
  for (int k = 0; k < lattice.size[2]; ++k)
    for (int j = 0; j < lattice.size[1]; ++j)
      for (int i = 0; i < lattice.size[0]; ++i)
        ASSERT_FLOAT_EQ(grid->tree().getValue({i, j, k}),
                        static_cast<float>(lattice.voxel) * field.values[lattice.index(i, j, k)]);
  const openvdb::Vec3d world = grid->indexToWorld(openvdb::Coord(3, 4, 5));
  EXPECT_TRUE(Vec3(world.x(), world.y(), world.z()).isApprox(lattice.point(3, 4, 5), 1e-14));
}

TEST(ToVdb, OnlyTheBandIsActive) {
  const DistanceField field = clamped_sphere();
  const float band = *std::max_element(field.values.begin(), field.values.end());
  const auto within = static_cast<std::size_t>(std::count_if(
      field.values.begin(), field.values.end(), [&](float value) { return std::abs(value) < band; }));
  EXPECT_EQ(read_back(to_vdb(field))->activeVoxelCount(), within);
}

TEST(ToVdb, EqualFieldsGiveEqualBytes) {
  EXPECT_EQ(to_vdb(clamped_sphere()), to_vdb(clamped_sphere()));
}

TEST(ToVdb, EmptyField) {
  const auto grid = read_back(to_vdb(
      DistanceField{.lattice = {.origin = Vec3::Zero(), .voxel = 1, .size = {0, 0, 0}}, .values = {}}));
  ASSERT_TRUE(grid);
  EXPECT_EQ(grid->activeVoxelCount(), 0u);
}

}  // namespace
}  // namespace skinforge
