#include <gtest/gtest.h>
#include <openvdb/tools/VolumeToMesh.h>

#include <map>
#include <numbers>
#include <random>

#include "base/parallel.h"
#include "field/signed_distance.h"
#include "testing/fields.h"

namespace skinforge {
namespace {

double signed_volume(const IsoSurface& s) {
  double sum = 0;
  for (const auto& t : s.triangles)
    sum += s.positions[t[0]].dot(s.positions[t[1]].cross(s.positions[t[2]])) / 6;
  return sum;
}

// How often each directed edge occurs; closed and oriented means: once, and once the other way.
std::map<std::pair<int, int>, int> directed_edges(const IsoSurface& s) {
  std::map<std::pair<int, int>, int> edges;
  for (const auto& t : s.triangles)
    for (int i = 0; i < 3; ++i) ++edges[{t[i], t[(i + 1) % 3]}];
  return edges;
}

int open_edges(const IsoSurface& s) {
  const auto edges = directed_edges(s);
  int open = 0;
  for (const auto& [edge, count] : edges) open += !edges.contains({edge.second, edge.first});
  return open;
}

DistanceField sphere_field(int n, double half) {
  return testing::sampled(testing::centred_lattice(n, half), [](const Vec3& p) { return p.norm() - 1; });
}

// A unit sphere at 24 voxels across: the dual surface lies inside the sphere by less than a tenth of a voxel.
TEST(ExtractIsoSurface, SphereIsClosedOutwardAndClose) {
  const DistanceField field = sphere_field(41, 1.6);
  const IsoSurface surface = extract_iso_surface(field);
  EXPECT_EQ(open_edges(surface), 0);
  for (const auto& [edge, count] : directed_edges(surface)) EXPECT_EQ(count, 1);
  for (const Vec3& p : surface.positions) EXPECT_NEAR(p.norm(), 1, 0.1 * field.lattice.voxel);
  EXPECT_NEAR(signed_volume(surface), 4 * std::numbers::pi / 3, 0.03);
  const auto euler =
      static_cast<int>(surface.positions.size()) - static_cast<int>(surface.triangles.size()) / 2;
  EXPECT_EQ(euler, 2);
}

// A plane through the lattice leaves it by an open edge all around, and nothing is closed behind it.
TEST(ExtractIsoSurface, OpenAtTheLatticeFaces) {
  const Lattice lattice = testing::centred_lattice(9, 1);
  const IsoSurface surface =
      extract_iso_surface(testing::sampled(lattice, [](const Vec3& p) { return p.z() - 0.1; }));
  ASSERT_FALSE(surface.triangles.empty());
  EXPECT_EQ(surface.positions.size(), 64u);  // one per cell of the layer 8 x 8
  EXPECT_EQ(surface.triangles.size(), 2u * 49u);
  EXPECT_EQ(open_edges(surface), 28);
  for (const auto& t : surface.triangles) {
    const Vec3 normal = (surface.positions[t[1]] - surface.positions[t[0]])
                            .cross(surface.positions[t[2]] - surface.positions[t[0]]);
    EXPECT_GT(normal.z(), 0);  // outward: towards larger values
  }
  for (const Vec3& p : surface.positions) EXPECT_NEAR(p.z(), 0.1, 1e-6);
}

TEST(ExtractIsoSurface, SphereLargerThanTheLatticeIsCutOff) {
  const IsoSurface surface = extract_iso_surface(sphere_field(17, 0.8));
  EXPECT_GT(open_edges(surface), 0);
  for (const Vec3& p : surface.positions) {
    EXPECT_LE(p.cwiseAbs().maxCoeff(), 0.8);
    EXPECT_NEAR(p.norm(), 1, 0.02);
  }
}

// Quads of OpenVDB's dual contouring that lie in the lattice, each with its corners in voxels.
std::vector<std::array<Vec3, 4>> openvdb_quads(const DistanceField& field) {
  const auto& size = field.lattice.size;
  const auto grid = openvdb::FloatGrid::create(100);
  auto accessor = grid->getAccessor();
  for (int k = -1; k <= size[2]; ++k)
    for (int j = -1; j <= size[1]; ++j)
      for (int i = -1; i <= size[0]; ++i)
        accessor.setValue(
            openvdb::Coord(i, j, k),
            field.values[field.lattice.index(std::clamp(i, 0, size[0] - 1), std::clamp(j, 0, size[1] - 1),
                                             std::clamp(k, 0, size[2] - 1))]);
  std::vector<openvdb::Vec3s> points;
  std::vector<openvdb::Vec4I> all;
  openvdb::tools::volumeToMesh(*grid, points, all, 0.0);
  std::vector<std::array<Vec3, 4>> quads;
  for (const openvdb::Vec4I& q : all) {
    std::array<Vec3, 4> corners;
    bool is_in_lattice = true;
    for (int c = 0; c < 4; ++c) {
      const openvdb::Vec3s& p = points[q[c]];
      corners[c] = Vec3(p.x(), p.y(), p.z());
      for (int axis = 0; axis < 3; ++axis)
        is_in_lattice &= corners[c][axis] >= 0 && corners[c][axis] <= size[axis] - 1;
    }
    if (is_in_lattice) quads.push_back(corners);
  }
  return quads;
}

// Law: the same quads, in the same order, to the last bit. Of noise, where most cells have several sheets and
// ambiguous faces.
TEST(ExtractIsoSurface, AsOpenVdbHasIt) {
  openvdb::initialize();
  std::mt19937 random(11);
  std::normal_distribution<double> noise;
  for (const double inside : {-1.0, -0.3, 0.0, 0.7}) {
    Lattice lattice{.origin = Vec3::Zero(), .voxel = 1, .size = {19, 140, 23}};
    DistanceField field = testing::sampled(lattice, [&](const Vec3&) { return noise(random) - inside; });
    field.values[100] = 0;
    const IsoSurface surface = extract_iso_surface(field);
    const auto quads = openvdb_quads(field);
    ASSERT_EQ(surface.triangles.size(), 2 * quads.size());
    for (std::size_t q = 0; q < quads.size(); ++q) {
      const auto &first = surface.triangles[2 * q], &second = surface.triangles[2 * q + 1];
      const bool is_split_at_0 = first[2] == second[1];
      const std::array<std::int32_t, 4> own = {first[0], first[1], is_split_at_0 ? first[2] : second[1],
                                               second[2]};
      for (int c = 0; c < 4; ++c) ASSERT_EQ(surface.positions[own[c]], quads[q][c]) << q;
    }
  }
}

TEST(ExtractIsoSurface, NothingToFind) {
  const Lattice lattice = testing::centred_lattice(12, 1);
  EXPECT_TRUE(
      extract_iso_surface(testing::sampled(lattice, [](const Vec3&) { return 1.0; })).triangles.empty());
  EXPECT_TRUE(
      extract_iso_surface(testing::sampled(lattice, [](const Vec3&) { return -1.0; })).triangles.empty());
  EXPECT_TRUE(extract_iso_surface(DistanceField{}).triangles.empty());
}

// Counts do not depend on the unit and positions scale with it.
TEST(ExtractIsoSurface, ScalesWithTheLattice) {
  DistanceField field = sphere_field(25, 1.5);
  const IsoSurface one = extract_iso_surface(field);
  field.lattice.origin *= 100;
  field.lattice.voxel *= 100;
  const IsoSurface hundred = extract_iso_surface(field);
  ASSERT_EQ(one.triangles, hundred.triangles);
  for (std::size_t i = 0; i < one.positions.size(); ++i)
    EXPECT_LT((100 * one.positions[i] - hundred.positions[i]).norm(), 1e-4);
}

TEST(ExtractIsoSurface, SameBitsForAnyNumberOfThreads) {
  const DistanceField field = sphere_field(61, 1.5);
  set_thread_limit(1);
  const IsoSurface one = extract_iso_surface(field);
  set_thread_limit(4);
  const IsoSurface four = extract_iso_surface(field);
  EXPECT_EQ(one.triangles, four.triangles);
  EXPECT_EQ(one.positions, four.positions);
}

}  // namespace
}  // namespace skinforge
