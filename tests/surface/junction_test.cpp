#include "surface/junction.h"

#include <gtest/gtest.h>

#include "surface/junction_scene.h"

namespace skinforge {
namespace {

using testing::JunctionScene;

// Borders by index: the fixed vertices are those of the loops, and each border edge is used once, in the
// loop's direction; nothing else is open.
void expect_closed_on_its_loops(const Junction& junction) {
  const auto uses = testing::half_edge_uses(junction.patch.triangles);
  std::set<std::pair<std::int32_t, std::int32_t>> border, open;
  std::int32_t first = 0;
  for (const JunctionLoop& loop : junction.loops) {
    const auto n = static_cast<std::int32_t>(loop.positions.size());
    for (std::int32_t i = 0; i < n; ++i) {
      EXPECT_EQ(junction.patch.positions[first + i], loop.positions[i]);
      border.insert({first + i, first + (i + 1) % n});
    }
    first += n;
  }
  EXPECT_EQ(junction.patch.fixed, static_cast<std::size_t>(first));
  for (const auto& [edge, number] : uses) {
    EXPECT_EQ(number, 1);
    if (!uses.contains({edge.second, edge.first})) open.insert(edge);
  }
  EXPECT_EQ(open, border);
}

// The joined surface of the scene is closed and manifold.
MeshTopology joined_topology(const JunctionScene& scene, const Junction& junction) {
  return measure_topology(assemble_surface(scene.sources, std::vector<Junction>{junction}).mesh);
}

void expect_closed(const MeshTopology& topology) {
  EXPECT_EQ(topology.boundary_edges, 0u);
  EXPECT_EQ(topology.non_manifold_edges + topology.non_manifold_vertices, 0u);
  EXPECT_EQ(topology.degenerate_faces, 0u);
  EXPECT_EQ(topology.components, 1u);
}

// A ring between two borders has Euler number 0, the whole closed tube 2.
TEST(BuildJunction, TubesEndToEnd) {
  const JunctionScene scene = testing::tubes_end_to_end();
  ASSERT_EQ(scene.loops.size(), 2u);
  const Junction junction = scene.junction();
  EXPECT_EQ(junction.rung, JunctionRung::Tube) << junction.reason;
  EXPECT_TRUE(junction.reason.empty());
  EXPECT_FALSE(junction.faults.any()) << describe(junction.faults);
  EXPECT_EQ(junction.voxel, scene.field.voxel());
  expect_closed_on_its_loops(junction);
  EXPECT_EQ(testing::topology_of(junction.patch).euler, 0);
  EXPECT_EQ(testing::chord_count(junction.patch), 0);
  const MeshTopology whole = joined_topology(scene, junction);
  expect_closed(whole);
  EXPECT_EQ(whole.euler, 2);
}

// The blend of two coaxial tubes lies between their radii, within a voxel for what the lattice cannot show.
TEST(BuildJunction, RunsBetweenTheTwoRadii) {
  const JunctionScene scene = testing::tubes_end_to_end();
  const Junction junction = scene.junction();
  const double least = 0.8 * std::cos(std::numbers::pi / 12) - 0.5 * junction.voxel;
  for (std::size_t v = junction.patch.fixed; v < junction.patch.positions.size(); ++v) {
    const Vec3& p = junction.patch.positions[v];
    EXPECT_GT(std::hypot(p.y(), p.z()), least);
    EXPECT_LT(std::hypot(p.y(), p.z()), 1 + 0.5 * junction.voxel);
    EXPECT_LT(std::abs(p.x()), 1.5);
  }
}

TEST(BuildJunction, TubeAddedToABox) {
  const JunctionScene scene = testing::tube_on_a_box();
  ASSERT_EQ(scene.loops.size(), 2u);
  const Junction junction = scene.junction();
  EXPECT_EQ(junction.rung, JunctionRung::Tube) << junction.reason;
  EXPECT_FALSE(junction.faults.any()) << describe(junction.faults);
  expect_closed_on_its_loops(junction);
  const MeshTopology whole = joined_topology(scene, junction);
  expect_closed(whole);
  EXPECT_EQ(whole.euler, 2);
}

// Law: everything a hundred times larger gives the same triangles a hundred times larger.
TEST(BuildJunction, ScalesWithItsInputs) {
  constexpr double kScale = 100;
  for (const auto& scene_of : {testing::tubes_end_to_end, testing::tube_on_a_box}) {
    const Junction small = scene_of(1).junction(), large = scene_of(kScale).junction();
    EXPECT_EQ(large.rung, small.rung);
    EXPECT_NEAR(large.voxel, kScale * small.voxel, 1e-9 * large.voxel);
    ASSERT_EQ(large.patch.triangles, small.patch.triangles);
    for (std::size_t v = 0; v < small.patch.positions.size(); ++v) {
      const Vec3& p = small.patch.positions[v];
      EXPECT_LT((large.patch.positions[v] / kScale - p).norm(), 1e-6) << v;  // the field is kept in floats
    }
  }
}

TEST(BuildJunction, WithoutLoopsNothing) {
  const Junction junction = build_junction({}, {}, {});
  EXPECT_EQ(junction.rung, JunctionRung::None);
  EXPECT_TRUE(junction.patch.triangles.empty());
  EXPECT_NE(junction.reason.find("joined rigidly"), std::string::npos);
}

// A removal leaves a host alone: its border is closed by a cap that bulges out along the wall.
TEST(BuildJunction, HostAloneIsCapped) {
  const JunctionScene scene =
      testing::junction_scene({{testing::closed_tube(19, 14, -6, 0.5, 1), testing::falling, true, true}});
  ASSERT_EQ(scene.loops.size(), 1u);
  const Junction junction = scene.junction();
  EXPECT_EQ(junction.rung, JunctionRung::Cap);
  EXPECT_TRUE(junction.reason.empty());
  EXPECT_FALSE(junction.faults.any()) << describe(junction.faults);
  expect_closed_on_its_loops(junction);
  EXPECT_EQ(testing::topology_of(junction.patch).euler, 1);
  const double border = junction.loops[0].positions[0].x();
  for (std::size_t v = junction.patch.fixed; v < junction.patch.positions.size(); ++v)
    EXPECT_GT(junction.patch.positions[v].x(), border);
  expect_closed(joined_topology(scene, junction));
}

// Without a field the two borders are bridged directly.
TEST(BuildJunction, BridgeWithoutAField) {
  JunctionScene scene = testing::tubes_end_to_end();
  scene.field = {};
  const Junction junction = scene.junction();
  EXPECT_EQ(junction.rung, JunctionRung::Bridge);
  EXPECT_EQ(junction.voxel, 0);
  EXPECT_FALSE(junction.faults.any()) << describe(junction.faults);
  expect_closed_on_its_loops(junction);
  EXPECT_EQ(testing::topology_of(junction.patch).euler, 0);
  expect_closed(joined_topology(scene, junction));
}

// The field lies somewhere else: the border has no ring of it, and the reason says so.
TEST(BuildJunction, BridgeWhereTheFieldIsAway) {
  JunctionScene scene = testing::tubes_end_to_end();
  scene.field.distance.lattice.origin += Vec3(0, 100, 0);
  const Junction junction = scene.junction();
  EXPECT_EQ(junction.rung, JunctionRung::Bridge);
  EXPECT_EQ(junction.reason, "the blended surface leaves border 1 of 2 without a ring");
  expect_closed_on_its_loops(junction);
}

}  // namespace
}  // namespace skinforge
