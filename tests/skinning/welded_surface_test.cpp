#include "skinning/welded_surface.h"

#include <gtest/gtest.h>

namespace skinforge {
namespace {

// Two triangles that share an edge, each with vertices of its own, as face groups come out of importers:
// corners 1, 2 of the first are 4, 3 of the second.
struct TwoParts {
  std::vector<Vec3> positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}};
  std::vector<VertexTriangle> triangles{{VertexId(0), VertexId(1), VertexId(2)},
                                        {VertexId(3), VertexId(4), VertexId(5)}};
};

TEST(WeldedSurface, OneVertexAPlace) {
  const TwoParts parts;
  const WeldedSurface surface = weld_surface(parts.positions, parts.triangles);
  ASSERT_EQ(surface.positions.size(), 4u);
  EXPECT_EQ(surface.triangles[1], (VertexTriangle{VertexId(2), VertexId(1), VertexId(3)}));
  EXPECT_EQ(surface.original[3], VertexId(5));
  EXPECT_EQ(surface.spread(std::span<const Vec3>(surface.positions)), parts.positions);
}

TEST(WeldedSurface, VerticesOfOtherWeightsStayApart) {
  const TwoParts parts;
  SkinWeights weights;
  for (const int joint : {0, 0, 0, 0, 1, 0}) weights.push_row(std::vector<Influence>{{JointId(joint), 1.0}});
  EXPECT_EQ(weld_surface(parts.positions, parts.triangles, &weights).positions.size(), 5u);
}

// Held by one of the copies: held. Held by two joints: free.
TEST(WeldedSurface, HandlesOfCopies) {
  const TwoParts parts;
  const WeldedSurface surface = weld_surface(parts.positions, parts.triangles);
  const JointId a(0), b(1), none;
  EXPECT_EQ(surface.weld({a, a, none, b, b, b}), (Handles{a, none, b, b}));
  EXPECT_EQ(surface.spread(Handles{a, none, b, b}), (Handles{a, none, b, b, none, b}));
}

TEST(WeldedSurface, TrianglesThatFallTogetherGo) {
  const std::vector<Vec3> positions{{0, 0, 0}, {0, 0, 0}, {1, 0, 0}};
  const std::vector<VertexTriangle> triangles{{VertexId(0), VertexId(1), VertexId(2)}};
  EXPECT_TRUE(weld_surface(positions, triangles).triangles.empty());
}

}  // namespace
}  // namespace skinforge
