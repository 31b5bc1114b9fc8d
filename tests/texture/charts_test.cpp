#include "texture/charts.h"

#include <gtest/gtest.h>

#include <set>

#include "texture/tube_mesh.h"

namespace skinforge {
namespace {

using testing::all_faces;
using testing::tube_mesh;

constexpr double kRounding = 1e-9;  // projections and turns of lengths near 1

std::set<std::size_t> faces_of(const std::vector<Chart>& charts) {
  std::set<std::size_t> faces;
  for (const Chart& chart : charts) faces.insert(chart.faces.begin(), chart.faces.end());
  return faces;
}

// A flat grid is one chart, isometric: 3 x 1 metres, longer side along x.
TEST(GrowCharts, FlatSurfaceIsOneIsometricChart) {
  const PolygonMesh mesh = testing::flat_grid(1, 3);
  const auto charts = grow_charts(mesh, all_faces(mesh));
  ASSERT_EQ(charts.size(), 1u);
  EXPECT_NEAR(charts[0].size.x(), 3, kRounding);
  EXPECT_NEAR(charts[0].size.y(), 1, kRounding);
  for (std::size_t i = 0; i < charts[0].faces.size(); ++i) {
    const auto& c = charts[0].corners[i];
    EXPECT_NEAR((c[1] - c[0]).norm(), 1, kRounding);
    EXPECT_NEAR((c[2] - c[0]).norm(), std::sqrt(2.0), kRounding);
  }
}

// An octagonal tube turns 45 degrees from side to side: every face lies in exactly one chart, charts go along
// the whole length, and none turns back.
TEST(GrowCharts, TubeFallsIntoLongStrips) {
  const PolygonMesh mesh = tube_mesh(9, 8, 0, 0.5, 1);
  const auto charts = grow_charts(mesh, all_faces(mesh));
  EXPECT_EQ(faces_of(charts).size(), mesh.face_count());
  std::size_t total = 0;
  for (const Chart& chart : charts) total += chart.faces.size();
  EXPECT_EQ(total, mesh.face_count());
  EXPECT_LE(charts.size(), 6u);
}

TEST(GrowCharts, NoTurnGivesEveryFaceItsOwn) {
  const PolygonMesh mesh = tube_mesh(3, 8, 0, 1, 1);
  EXPECT_EQ(grow_charts(mesh, all_faces(mesh), {.max_turn_deg = 0}).size(), mesh.face_count());
}

// A strip that climbs in a full turn (a spiral stair) would lie on itself: the overlap splits it.
TEST(GrowCharts, SpiralDoesNotOverlapItself) {
  const PolygonMesh mesh = testing::spiral(40, 16);
  const auto charts = grow_charts(mesh, all_faces(mesh));
  EXPECT_GE(charts.size(), 3u);  // two and a half turns
  EXPECT_EQ(faces_of(charts).size(), mesh.face_count());
}

TEST(GrowCharts, DegenerateFacesStillGetAChart) {
  PolygonMesh mesh = testing::flat_grid(1, 2);
  for (Vec3& p : mesh.positions) p = Vec3(1, 2, 3);
  const auto charts = grow_charts(mesh, all_faces(mesh));
  EXPECT_EQ(faces_of(charts).size(), 2u);
  EXPECT_EQ(charts[0].size, Vec2(0, 0));
  EXPECT_TRUE(grow_charts(mesh, {}).empty());
}

}  // namespace
}  // namespace skinforge
