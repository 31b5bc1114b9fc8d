#include "geometry/uv_measures.h"

#include <gtest/gtest.h>

#include <limits>

#include "testing/shapes.h"

namespace skinforge {
namespace {
constexpr double kRounding = 1e-12;  // a few operations in double

struct Rectangle {
  double left, bottom, right, top;
};

// Squares of one metre beside each other, each with its rectangle of the texture.
PolygonMesh squares(const std::vector<Rectangle>& rectangles) {
  std::vector<Vec3> positions;
  std::vector<std::vector<int>> faces;
  std::vector<Vec2> uvs;
  for (const Rectangle& r : rectangles) {
    const double x = 2.0 * double(faces.size());
    const int first = static_cast<int>(positions.size());
    for (const Vec3& p : {Vec3(x, 0, 0), Vec3(x + 1, 0, 0), Vec3(x + 1, 1, 0), Vec3(x, 1, 0)})
      positions.push_back(p);
    faces.push_back({first, first + 1, first + 2, first + 3});
    for (const Vec2& uv :
         {Vec2(r.left, r.bottom), Vec2(r.right, r.bottom), Vec2(r.right, r.top), Vec2(r.left, r.top)})
      uvs.push_back(uv);
  }
  PolygonMesh mesh = testing::polygon_mesh(positions, faces);
  mesh.uvs = {uvs};
  mesh.parts[0].uv_sets = 1;
  return mesh;
}

double overlap(const std::vector<Rectangle>& rectangles) {
  return measure_uvs(squares(rectangles)).overlap;
}

TEST(UvMeasures, AnEvenMapHasStretchOne) {
  for (const Rectangle& r : {Rectangle{0, 0, 1, 1}, Rectangle{0.25, 0.5, 0.5, 0.75}, Rectangle{1, 0, 0, 1}}) {
    const UvMeasures uv = measure_uvs(squares({r}));
    EXPECT_NEAR(uv.stretch, 1, kRounding);
    EXPECT_NEAR(uv.stretch_max, 1, kRounding);
    EXPECT_EQ(uv.triangles, 2U);
    EXPECT_EQ(uv.overlap, 0);
  }
}

// By hand: a metre is the whole width and a quarter of the height, so the derivatives are 1 and 4 long; half
// the sum of their squares is 8.5, and the areas are 1 to 1/4.
TEST(UvMeasures, StretchOfARectangle) {
  EXPECT_NEAR(measure_uvs(squares({{0, 0, 1, 0.25}})).stretch, std::sqrt(8.5 / 4), kRounding);
}

// By hand: squares of 1/4 and 1/2 have stretch 4 and 2, in the mean of squares 10; the areas in the texture,
// 1/16 and 1/4, are 5/32 of those on the surface.
TEST(UvMeasures, StretchOfTheWholeIsWeightedByArea) {
  const UvMeasures uv = measure_uvs(squares({{0, 0, 0.25, 0.25}, {0.5, 0.5, 1, 1}}));
  EXPECT_NEAR(uv.stretch, std::sqrt(10 * 5 / 32.0), kRounding);
  EXPECT_NEAR(uv.stretch_max, std::sqrt(16 * 5 / 32.0), kRounding);
}

// By hand: of 3/4 that are covered 1/4 is covered twice; what stands beyond the border comes in at the other.
TEST(UvMeasures, Overlap) {
  EXPECT_EQ(overlap({{0, 0, 0.5, 1}, {0.5, 0, 1, 1}}), 0);
  EXPECT_EQ(overlap({{0, 0, 0.5, 1}, {0.5, 0, 0, 1}}), 1);
  EXPECT_NEAR(overlap({{0, 0, 0.5, 1}, {0.25, 0, 0.75, 1}}), 1.0 / 3, kRounding);
  EXPECT_NEAR(overlap({{0.75, -1, 1.25, 0}, {0, 0, 0.25, 1}}), 0.5, kRounding);
  EXPECT_EQ(overlap({{0, 0, 2, 1}}), 1);
  EXPECT_EQ(overlap({{0, 0, 1, 3}}), 1);
}

TEST(UvMeasures, MaterialsDoNotShareATexture) {
  PolygonMesh mesh = squares({{0, 0, 0.5, 1}, {0, 0, 0.5, 1}});
  mesh.face_material = {MaterialId(0), MaterialId(1)};
  EXPECT_EQ(measure_uvs(mesh).overlap, 0);
}

// Law: triangles that share edges do not overlap, however they lie.
TEST(UvMeasures, NeighboursDoNotOverlap) {
  constexpr int kSide = 9;
  for (const double turn : {0.0, 0.3, 0.785398163397448, 1.2}) {
    std::vector<Vec3> positions;
    std::vector<std::vector<int>> faces;
    for (int i = 0; i <= kSide; ++i)
      for (int j = 0; j <= kSide; ++j) positions.emplace_back(i, j, 0);
    for (int i = 0; i < kSide; ++i)
      for (int j = 0; j < kSide; ++j) {
        const int at = i * (kSide + 1) + j;
        faces.push_back({at, at + kSide + 1, at + kSide + 2, at + 1});
      }
    PolygonMesh mesh = testing::polygon_mesh(positions, faces);
    mesh.parts[0].uv_sets = 1;
    mesh.uvs.resize(1);
    const Eigen::Rotation2Dd rotation(turn);
    for (const VertexId v : mesh.corners)
      mesh.uvs[0].push_back(rotation * Vec2(mesh.positions[v.index()].head<2>() / 16));
    const UvMeasures uv = measure_uvs(mesh);
    EXPECT_EQ(uv.overlap, 0) << turn;
    EXPECT_NEAR(uv.stretch, 1, kRounding) << turn;
  }
}

TEST(UvMeasures, OddMaps) {
  EXPECT_EQ(measure_uvs(PolygonMesh()).triangles, 0U);
  const UvMeasures point = measure_uvs(squares({{0.5, 0.5, 0.5, 0.5}}));
  EXPECT_EQ(point.flat, 2U);
  EXPECT_EQ(point.stretch, 0);
  EXPECT_EQ(overlap({{0, 0, 1e30, 1}}), 0);
  EXPECT_EQ(overlap({{0, 0, std::numeric_limits<double>::quiet_NaN(), 1}}), 0);
  PolygonMesh without = squares({{0, 0, 1, 1}});
  without.parts[0].uv_sets = 0;
  EXPECT_EQ(measure_uvs(without).triangles, 0U);
}

}  // namespace
}  // namespace skinforge
