#include "skinning/junction_shares.h"

#include <gtest/gtest.h>

#include "base/parallel.h"
#include "skinning/tube_scene.h"

namespace skinforge {
namespace {

using testing::replaced_tubes;
using testing::TubeScene;

constexpr double kRounding = 1e-9;  // a sparse solve over two dozen unknowns

double factor_of_ring(const JunctionShares& shares, std::size_t source, int ring) {
  return shares.factor[source][static_cast<std::size_t>(ring) * TubeScene::kAround];
}

// By hand: r_0 falls 1, 3/4, 1/2, 1/4, 0 over the rings x = -2 .. 2, and so does p_0 = 0.5 - x / 4, so at x =
// -1 factor_0 = (3/4 * 3/4) / (3/4 * 3/4 + 1/4 * 1/4) = 9 / 10, at 0 it is 1 / 2, at 1 it is 1 / 10.
TEST(JunctionShares, PresenceTimesHarmonicRamp) {
  const TubeScene scene = replaced_tubes();
  const auto shares = junction_shares(scene.surface(), scene.surfaces());
  EXPECT_NEAR(factor_of_ring(shares, 0, 4), 0.9, kRounding);
  EXPECT_NEAR(factor_of_ring(shares, 0, 5), 0.5, kRounding);
  EXPECT_NEAR(factor_of_ring(shares, 0, 6), 0.1, kRounding);
  EXPECT_EQ(factor_of_ring(shares, 0, 3), 1.0);
  EXPECT_EQ(factor_of_ring(shares, 1, 3), 0.0);
  EXPECT_EQ(factor_of_ring(shares, 1, 7), 1.0);
  EXPECT_EQ(shares.new_vertices.size(), 3u * TubeScene::kAround);
}

// By hand: on an attached tube of the same radius both distances are 0, the switch stands at one half, and
// the ramp alone decides: 3/4, 1/2, 1/4.
TEST(JunctionShares, AttachFollowsDistance) {
  TubeScene scene = replaced_tubes();
  scene.sources[1].attached = true;
  const auto shares = junction_shares(scene.surface(), scene.surfaces());
  EXPECT_NEAR(factor_of_ring(shares, 0, 4), 0.75, kRounding);
  EXPECT_NEAR(factor_of_ring(shares, 0, 6), 0.25, kRounding);
}

// A thinner donor: vertices of the junction on the host's surface belong to the host though the ramp is at
// one half.
TEST(JunctionShares, AttachGivesTheNearerSurfaceMore) {
  TubeScene scene = replaced_tubes();
  scene.sources[1] = testing::tube_source(
      testing::tube(8, TubeScene::kAround, -2, 1, 0.5), scene.sources[1].map, [](double) { return 1.0; },
      [](double) { return testing::two_joint_row(1); });
  scene.sources[1].attached = true;
  const auto shares = junction_shares(scene.surface(), scene.surfaces());
  EXPECT_GT(factor_of_ring(shares, 0, 5), 0.9);
}

TEST(JunctionShares, SumToOneEverywhere) {
  const TubeScene scene = replaced_tubes();
  const auto shares = junction_shares(scene.surface(), scene.surfaces());
  for (std::size_t v = 0; v < scene.origins.size(); ++v) {
    EXPECT_NEAR(shares.factor[0][v] + shares.factor[1][v], 1, kRounding);
    EXPECT_GE(std::min(shares.factor[0][v], shares.factor[1][v]), 0);
  }
}

// A cap (remove): the junction touches source 0 alone, so source 0 has all of it, even where its presence is
// 0.
TEST(JunctionShares, CapBelongsToItsOnlyNeighbour) {
  TubeScene scene = replaced_tubes();
  scene.result = testing::tube(7, TubeScene::kAround, -5, 1, 1);
  scene.origins.resize(7 * TubeScene::kAround);
  scene.graph = build_vertex_graph(scene.result);
  std::fill(scene.sources[0].presence.begin(), scene.sources[0].presence.end(), 0.0);
  const auto shares = junction_shares(scene.surface(), scene.surfaces());
  for (std::size_t v = 0; v < scene.origins.size(); ++v) EXPECT_NEAR(shares.factor[0][v], 1, kRounding);
}

// A loose ring of new vertices touches nothing: it still gets shares, from the nearer source the larger one.
TEST(JunctionShares, FloatingClusterGoesByDistance) {
  TubeScene scene = replaced_tubes();
  scene.result = testing::tube(2, TubeScene::kAround, 4, 1, 1);
  scene.origins.assign(2 * TubeScene::kAround, VertexOrigin{});
  scene.graph = build_vertex_graph(scene.result);
  const auto shares = junction_shares(scene.surface(), scene.surfaces());
  for (std::size_t v = 0; v < scene.origins.size(); ++v) EXPECT_GT(shares.factor[1][v], 0.9);
}

// Scale leaves no trace: no absolute length anywhere.
TEST(JunctionShares, ScaleFree) {
  const TubeScene scene = replaced_tubes();
  TubeScene large = replaced_tubes();
  for (Vec3& p : large.result.positions) p *= 1000;
  for (auto& source : large.sources) {
    std::vector<std::array<std::int32_t, 3>> soup;
    for (Vec3& p : source.mesh.positions) p *= 1000;
    for (const auto& t : source.triangles.triangles) soup.push_back({t[0].value, t[1].value, t[2].value});
    source.bvh = std::make_unique<TriangleBvh>(source.mesh.positions, soup);
    source.attached = true;
  }
  TubeScene small = replaced_tubes();
  for (auto& source : small.sources) source.attached = true;
  const auto a = junction_shares(small.surface(), small.surfaces());
  const auto b = junction_shares(large.surface(), large.surfaces());
  for (std::size_t v = 0; v < scene.origins.size(); ++v)
    EXPECT_NEAR(a.factor[0][v], b.factor[0][v], kRounding);
}

TEST(JunctionShares, WithoutNewVertices) {
  TubeScene scene = replaced_tubes();
  for (std::size_t v = 0; v < scene.origins.size(); ++v)
    if (scene.origins[v].is_new()) scene.origins[v] = {SourceId(0), VertexId(0)};
  const auto shares = junction_shares(scene.surface(), scene.surfaces());
  EXPECT_TRUE(shares.new_vertices.empty());
  EXPECT_EQ(shares.factor[0][40], 1.0);
}

TEST(JunctionShares, SameBitsForAnyNumberOfThreads) {
  const TubeScene scene = replaced_tubes();
  set_thread_limit(1);
  const auto alone = junction_shares(scene.surface(), scene.surfaces());
  set_thread_limit(4);
  EXPECT_EQ(alone.factor, junction_shares(scene.surface(), scene.surfaces()).factor);
}

}  // namespace
}  // namespace skinforge
