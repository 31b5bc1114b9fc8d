// Sheets and hems: surfaces without an inside, cut from one open border to another.
#include "surface/arc_strip.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "geometry/scaled_jacobian.h"
#include "surface/junction_scene.h"

namespace skinforge {
namespace {

using ::testing::Each;
using testing::JunctionScene;
using testing::sheet_along_x;

// A straight arc of n edges across x at that place, whose surface arrives along `onward`. New faces run along
// it towards growing y on the host's side.
JunctionLoop arc(int n, double x, const Vec3& onward, bool is_host) {
  JunctionLoop arc{SourceId(is_host ? 0 : 1), is_host, {}, {}, {}};
  for (int i = 0; i <= n; ++i) {
    const double y = 3.0 * i / n;
    arc.vertices.emplace_back(i);
    arc.positions.emplace_back(x, is_host ? y : 3 - y, 0);
    arc.inward.push_back({arc.positions.back() - onward});
  }
  return arc;
}

// Three unit squares wide and three long.
TEST(ArcStrip, EqualArcsGiveAGrid) {
  const ArcStrip strip = arc_strip(arc(3, 0, Vec3::UnitX(), true), arc(3, 3, -Vec3::UnitX(), false));
  EXPECT_EQ(strip.quads, 9u);
  EXPECT_EQ(strip.patch.triangles.size(), 18u);
  EXPECT_EQ(strip.patch.fixed, 8u);
  EXPECT_EQ(strip.hem_edges, 6u);
  for (const Vec3& p : strip.patch.positions) EXPECT_EQ(p.z(), 0);
  const MeshTopology topology = testing::topology_of(strip.patch);
  EXPECT_EQ(topology.boundary_edges, 12u);
  EXPECT_EQ(topology.euler, 1);
  for (const Triangle& t : strip.patch.triangles) {  // all the same way round
    const auto& p = strip.patch.positions;
    EXPECT_LT((p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]).z(), -0.1);
  }
}

TEST(ArcStrip, OneTriangleForEachEdgeMore) {
  for (const int m : {1, 2, 5, 8}) {
    const ArcStrip strip = arc_strip(arc(4, 0, Vec3::UnitX(), true), arc(m, 3, -Vec3::UnitX(), false));
    EXPECT_EQ(strip.patch.triangles.size() - 2 * strip.quads, static_cast<std::size_t>(std::abs(4 - m)));
    EXPECT_EQ(testing::topology_of(strip.patch).euler, 1);
  }
}

// It leaves the host upwards and arrives at the donor level.
TEST(ArcStrip, LeavesAsItsNeighboursArrive) {
  const ArcStrip strip = arc_strip(arc(3, 0, Vec3::UnitZ(), true), arc(3, 3, -Vec3::UnitX(), false));
  const Vec3& first = strip.patch.positions[strip.patch.fixed];
  EXPECT_GT(first.z(), 0.25);
  EXPECT_LT(first.x(), 1);
}

TEST(ArcStrips, WhatFindsNoOtherStaysOpen) {
  int open = 0;
  const std::vector<JunctionLoop> arcs = {arc(3, 0, Vec3::UnitX(), true), arc(3, 9, Vec3::UnitX(), true),
                                          arc(3, 8, -Vec3::UnitX(), false)};
  const auto strips = arc_strips(arcs, open);
  ASSERT_EQ(strips.size(), 1u);
  EXPECT_EQ(strips[0].arcs[0].positions, arcs[1].positions);
  EXPECT_EQ(open, 1);
}

// Half a leaf takes the place of half of another: one sheet, open along its hem only.
TEST(Sheets, ASheetGoesOnInASheet) {
  const JunctionScene scene =
      testing::junction_scene({{sheet_along_x(19, 4, -6, 0.5), testing::falling, true, true, false, {}},
                               {sheet_along_x(19, 6, -3, 0.5),
                                [](double x) { return testing::falling(-x); },
                                true,
                                false,
                                false,
                                {}}});
  EXPECT_TRUE(scene.field.is_empty());  // winding numbers know no inside here
  ASSERT_EQ(scene.arcs.size(), 2u);
  Junction junction;
  int open = 0;
  junction.strips = arc_strips(scene.arcs, open);
  EXPECT_EQ(open, 0);
  const ArcStrip& strip = junction.strips.at(0);
  EXPECT_FALSE(faults_of(strip.patch, strip.arcs, scene.kept).any());
  const MeshTopology whole = measure_topology(assemble_surface(scene.sources, std::vector{junction}).mesh);
  EXPECT_EQ(whole.components, 1u);
  EXPECT_EQ(whole.euler, 1);
  EXPECT_EQ(whole.non_manifold_edges + whole.degenerate_faces, 0u);
}

// A wing of one layer on a body: the body keeps all its faces, and the wing its root, inside the body.
TEST(Sheets, AnAddedSheetSticksIn) {
  const JunctionScene scene =
      testing::junction_scene({{testing::quad_box(8, 2), [](double) { return 1.0; }, false, true, false, {}},
                               {sheet_along_x(15, 4, 0.6, 0.4),
                                [](double x) { return testing::falling(2 * (2.1 - x)); },
                                true,
                                false,
                                true,
                                {}}},
                              Vec3(2, 0, 0));
  EXPECT_THAT(scene.sources[0].selection.kept, Each(1));
  EXPECT_TRUE(scene.loops.empty());
  double root = 10;
  for (std::size_t f = 0; f < scene.meshes[1].face_count(); ++f)
    if (scene.sources[1].selection.kept[f])
      for (const VertexId v : scene.meshes[1].face(FaceId(f)))
        root = std::min(root, scene.meshes[1].positions[v.index()].x());
  EXPECT_LT(root, 2);
}

// An open tube has an inside: it is joined as ever.
TEST(Sheets, AnOpenTubeIsNone) {
  const JunctionScene scene = testing::junction_scene(
      {{testing::open_tube(19, 14, -6, 0.5, 1), testing::falling, true, true, false, {}},
       {testing::open_tube(19, 12, -3, 0.5, 0.8),
        [](double x) { return testing::falling(-x); },
        true,
        false,
        false,
        {}}});
  EXPECT_EQ(scene.loops.size(), 2u);
  EXPECT_EQ(scene.junction().rung, JunctionRung::Tube);
}

}  // namespace
}  // namespace skinforge
