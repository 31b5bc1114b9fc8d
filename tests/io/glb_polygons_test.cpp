#include "io/glb_polygons.h"

#include <gmock/gmock.h>

#include <random>

namespace skinforge {
namespace {

using ::testing::ElementsAre;
using Indices = std::vector<std::uint32_t>;

std::vector<Vec3> flat(std::initializer_list<Vec2> points) {
  std::vector<Vec3> list;
  for (const Vec2& p : points) list.push_back({p.x(), p.y(), 0});
  return list;
}

TEST(GlbPolygons, AQuadIsSplitFromItsFirstCorner) {
  FanWriter fans;
  fans.add(flat({{0, 0}, {3, 0}, {4, 1}, {1, 1}}), Indices{5, 6, 7, 8});  // although 1-3 is shorter
  EXPECT_THAT(fans.indices(), ElementsAre(5, 6, 7, 5, 7, 8));
}

TEST(GlbPolygons, ConsecutivePolygonsStartAtDifferentVertices) {
  FanWriter fans;
  const auto square = flat({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  fans.add(square, Indices{5, 6, 7, 8});
  fans.add(square, Indices{5, 8, 9, 10});  // may not start at 5: takes the other end of the diagonal
  fans.add(flat({{0, 0}, {1, 0}, {0, 1}}), Indices{9, 1, 2});
  EXPECT_THAT(fans.indices(), ElementsAre(5, 6, 7, 5, 7, 8, 9, 10, 5, 9, 5, 8, 1, 2, 9));
  EXPECT_EQ(fans.broken_count(), 0u);
}

TEST(GlbPolygons, AConcaveQuadStartsWhereItDoesNotFold) {
  FanWriter fans;
  // An arrow head with its notch at corner 2, near corner 0; the fan must use the diagonal 0-2.
  fans.add(flat({{0, 0}, {4, -1}, {1, 0}, {4, 1}}), Indices{0, 1, 2, 3});
  EXPECT_THAT(fans.indices(), ElementsAre(0, 1, 2, 0, 2, 3));
}

TEST(GlbPolygons, WhatNoFanCoversBecomesTriangles) {
  // A U has no point that sees all of it.
  FanWriter fans;
  fans.add(flat({{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}}),
           Indices{0, 1, 2, 3, 4, 5, 6, 7});
  EXPECT_EQ(fans.broken_count(), 1u);
  ASSERT_EQ(fans.indices().size(), 6u * 3);
  for (std::size_t i = 3; i < fans.indices().size(); i += 3)
    EXPECT_NE(fans.indices()[i], fans.indices()[i - 3]);
}

TEST(GlbPolygons, PolygonsWithoutAreaStayWhole) {
  FanWriter fans;
  fans.add(flat({{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}}), Indices{0, 1, 2, 3, 4});
  EXPECT_EQ(fans.broken_count(), 0u);
  EXPECT_EQ(fans.indices().size(), 9u);
}

TEST(GlbPolygons, ConvexPolygonsInAnyOrderAreTakenApartAgain) {
  std::mt19937 random(7);
  FanWriter fans;
  std::vector<std::size_t> sizes;
  for (int i = 0; i < 2000; ++i) {
    const std::size_t n = 3 + random() % 5;
    std::vector<Vec3> positions;
    Indices vertices;
    const std::uint32_t first =
        static_cast<std::uint32_t>(random() % 4);  // few vertices: starts collide often
    for (std::size_t k = 0; k < n; ++k) {
      const double angle = 2 * 3.14159265358979 * static_cast<double>(k) / static_cast<double>(n);
      positions.push_back({std::cos(angle), std::sin(angle), 0});
      vertices.push_back(first + static_cast<std::uint32_t>(k));
    }
    fans.add(positions, vertices);
    sizes.push_back(n);
  }
  // Decode as any reader does: a new polygon begins where the first vertex changes.
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < fans.indices().size(); i += 3) {
    if (i > 0 && fans.indices()[i] == fans.indices()[i - 3])
      ++found.back();
    else
      found.push_back(3);
  }
  EXPECT_EQ(found, sizes);
}

}  // namespace
}  // namespace skinforge
