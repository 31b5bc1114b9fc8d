#include "texture/unroll.h"

#include <gtest/gtest.h>

#include <numeric>
#include <random>

#include "texture/tube_mesh.h"

namespace skinforge {
namespace {

using testing::all_faces;
using testing::tube_mesh;

constexpr double kRounding = 1e-9;  // one sparse solve over a few dozen unknowns

std::vector<std::size_t> all_members(const PolygonMesh& mesh) {
  std::vector<std::size_t> members(mesh.face_count());
  std::iota(members.begin(), members.end(), std::size_t{0});
  return members;
}

std::optional<Chart> unroll(const PolygonMesh& mesh) {
  return unroll_annulus(mesh, all_faces(mesh), all_members(mesh));
}

double area_of(const std::vector<Vec2>& p) {
  double twice = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vec2& a = p[i];
    const Vec2& b = p[(i + 1) % p.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return twice / 2;
}

// By hand: a prism is a developable strip: 12 chords of 2 sin 15 deg around, 4 metres along; every quad keeps
// its size.
TEST(UnrollAnnulus, PrismIsIsometric) {
  const PolygonMesh mesh = tube_mesh(5, 12, 0, 1, 1);
  const auto chart = unroll(mesh);
  ASSERT_TRUE(chart.has_value());
  const double chord = 2 * std::sin(std::numbers::pi / 12);
  EXPECT_NEAR(chart->size.x(), 12 * chord, kRounding);
  EXPECT_NEAR(chart->size.y(), 4, kRounding);
  for (const auto& c : chart->corners) EXPECT_NEAR(area_of(c), chord, kRounding);
}

// A tall tube comes out lying: x is the longer side.
TEST(UnrollAnnulus, LongerSideAlongX) {
  const auto chart = unroll(tube_mesh(21, 8, 0, 1, 1));
  ASSERT_TRUE(chart.has_value());
  EXPECT_NEAR(chart->size.x(), 20, 1e-6);
  for (const auto& c : chart->corners) EXPECT_GT(area_of(c), 0);
}

// Random bumps: nothing turns over, the area stays, everything lies in the box; also when all ids are
// shuffled.
TEST(UnrollAnnulus, BumpyTubeStaysValid) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> jitter(-0.12, 0.12);
  for (int round = 0; round < 10; ++round) {
    PolygonMesh mesh = tube_mesh(6, 14, 0, 0.5, 1);
    double area = 0;
    for (Vec3& p : mesh.positions) p += Vec3(jitter(random), jitter(random), jitter(random));
    const auto chart = unroll(mesh);
    ASSERT_TRUE(chart.has_value());
    double flat = 0;
    for (const auto& c : chart->corners) {
      EXPECT_GT(area_of(c), 0);
      flat += area_of(c);
      for (const Vec2& p : c) {
        EXPECT_GE(p.minCoeff(), -kRounding);
        EXPECT_LE((p - chart->size).maxCoeff(), kRounding);
      }
    }
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
      std::vector<Vec3> p;
      for (const VertexId v : mesh.face(FaceId(f))) p.push_back(mesh.positions[v.index()]);
      for (const auto& t : triangulate(std::span<const Vec3>(p)))
        area += (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]).norm() / 2;
    }
    EXPECT_NEAR(flat, area, 1e-6 * area);
  }
}

// A disc has one border; a flat ring from radius 1 to 200 would be squeezed to a fraction at its rim; a face
// that is there twice makes no surface: all left to projection.
TEST(UnrollAnnulus, RefusesWhatIsNoTube) {
  EXPECT_FALSE(unroll(testing::flat_grid(3, 3)).has_value());
  EXPECT_FALSE(unroll(testing::flat_ring(16, {1, 5, 30, 200})).has_value());
  PolygonMesh doubled = tube_mesh(3, 8, 0, 1, 1);
  testing::add_quad(doubled, 0, 1, 9, 8);
  testing::finish(doubled);
  EXPECT_FALSE(unroll(doubled).has_value());
}

TEST(UnrollAnnulus, DegenerateTubeIsRefused) {
  PolygonMesh mesh = tube_mesh(4, 8, 0, 1, 1);
  for (Vec3& p : mesh.positions) p = Vec3(1, 1, 1);
  EXPECT_FALSE(unroll(mesh).has_value());
}

// A flat ring could be unrolled, but projected it is one chart without any stretch.
TEST(MakeCharts, FlatRingIsProjected) {
  const PolygonMesh mesh = testing::flat_ring(16, {1, 2});
  ASSERT_TRUE(unroll(mesh).has_value());
  const auto charts = make_charts(mesh, all_faces(mesh));
  ASSERT_EQ(charts.size(), 1u);
  EXPECT_NEAR(charts[0].size.x(), 4, 0.1);  // the diameter
}

// Two tubes and a sheet in one list: two strips and one projected chart, every face once.
TEST(MakeCharts, EachPartItsOwnWay) {
  PolygonMesh mesh = tube_mesh(4, 8, 0, 1, 1);
  const auto append = [&](const PolygonMesh& other, const Vec3& shift) {
    const auto offset = static_cast<int>(mesh.positions.size());
    for (const Vec3& p : other.positions) mesh.positions.push_back(p + shift);
    for (std::size_t f = 0; f < other.face_count(); ++f) {
      const auto c = other.face(FaceId(f));
      testing::add_quad(mesh, c[0].value + offset, c[1].value + offset, c[2].value + offset,
                        c[3].value + offset);
    }
  };
  append(testing::flat_grid(2, 2), Vec3(20, 0, 0));
  append(tube_mesh(4, 8, 0, 1, 1), Vec3(40, 0, 0));
  testing::finish(mesh);
  const auto charts = make_charts(mesh, all_faces(mesh));
  ASSERT_EQ(charts.size(), 3u);
  EXPECT_EQ(charts[0].faces.size(), 24u);
  EXPECT_EQ(charts[1].faces.size(), 4u);
  EXPECT_EQ(charts[1].faces.front(), 24u);
  EXPECT_EQ(charts[2].faces.back(), mesh.face_count() - 1);
}

}  // namespace
}  // namespace skinforge
