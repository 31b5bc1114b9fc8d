#include "geometry/point_tree.h"

#include <gtest/gtest.h>

#include <random>

namespace skinforge {
namespace {

TEST(PointTree, NearestByHand) {
  const std::vector<Vec3> points = {{0, 0, 0}, {2, 0, 0}, {2, 0, 0}, {0, 5, 0}};
  const PointTree tree(points);
  EXPECT_EQ(tree.nearest({0.9, 0, 0}, 10), VertexId(0));
  EXPECT_EQ(tree.nearest({1, 0, 0}, 10), VertexId(0));  // as near to 1 and 2
  EXPECT_EQ(tree.nearest({3, 0, 0}, 10), VertexId(1));  // 2 is at the same place
  EXPECT_EQ(tree.nearest({0, 4, 0}, 1), VertexId(3));   // the limit itself counts
  EXPECT_EQ(tree.nearest({0, 3.9, 0}, 1), VertexId());
  EXPECT_EQ(PointTree({}).nearest({0, 0, 0}, 10), VertexId());
}

// Law: as a look at every point tells. Many points lie in common planes, and many at the same place.
TEST(PointTree, AsEveryPointTells) {
  std::mt19937 random(3);
  std::uniform_int_distribution<int> on_grid(0, 9);
  std::uniform_real_distribution<double> anywhere(-1, 10);
  std::vector<Vec3> points;
  for (int i = 0; i < 800; ++i) points.emplace_back(on_grid(random), on_grid(random), on_grid(random) / 4);
  const PointTree tree(points);
  for (int i = 0; i < 400; ++i) {
    Vec3 p(anywhere(random), anywhere(random), anywhere(random));
    if (i % 2 == 0) p = p.array().round();
    const double limit = i % 3 == 0 ? 0.5 : 100;
    VertexId expected;
    double least = limit * limit;
    for (std::size_t v = points.size(); v-- > 0;)
      if ((p - points[v]).squaredNorm() <= least)
        least = (p - points[v]).squaredNorm(), expected = VertexId(v);
    ASSERT_EQ(tree.nearest(p, limit), expected) << p.transpose();
  }
}

}  // namespace
}  // namespace skinforge
