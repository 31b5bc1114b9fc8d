#include "surface/improve_faces.h"

#include <gtest/gtest.h>

namespace skinforge {
namespace {

WantedSurface board() {
  return {[](const Vec3& p) { return Vec3(p.x(), p.y(), 0); },
          [](const Vec3&) { return Vec3(Vec3::UnitZ()); }};
}

// Four quads about a vertex that alone is free; the lines of the others at 0, `x` and 2, and 0, `y` and 2.
QuadPatch four_quads(double x, double y, const Vec3& free) {
  QuadPatch patch;
  for (const double v : {0.0, y, 2.0})
    for (const double u : {0.0, x, 2.0})
      if (u != x || v != y) patch.positions.emplace_back(u, v, 0);
  patch.fixed = 8;
  patch.positions.push_back(free);
  patch.quads = {{0, 1, 8, 3}, {1, 2, 4, 8}, {3, 8, 6, 5}, {8, 4, 7, 6}};
  return patch;
}

// By hand: where all four are squares all corners are right and the vertex is in the middle of its
// neighbours.
TEST(ImproveFaces, SettledAVertexIsWhereItBelongs) {
  const Vec3 start(1.9, 1.7, 0), middle(1, 1, 0);
  QuadPatch few = four_quads(1, 1, start), many = few;
  improve_faces(few, board(), FaceGoal::All);
  improve_faces(many, board(), FaceGoal::Settled);
  constexpr double kClose = 1e-3;  // of an edge: the lack is of fourth order about a right corner
  EXPECT_GT((few.positions[8] - middle).norm(), kClose);
  EXPECT_LT((many.positions[8] - middle).norm(), kClose);
}

// Lines so near to each other that a step of six tenths of a mean edge goes far beyond two of the faces: all
// four are rectangles in the end, but for the pull towards the middle of the neighbours. With steps of the
// mean edge one was left at 0.5.
TEST(ImproveFaces, NarrowFacesDoNotTurnOver) {
  QuadPatch patch = four_quads(0.05, 1.98, {0.15, 1.88, 0});
  improve_faces(patch, board(), FaceGoal::Settled);
  EXPECT_GT(least_scaled_jacobian(patch), 0.9);
}

// Law: what differs by little ends nearer to each other. With steps of the mean edge it ended up to 100000
// times as far apart where faces are narrow.
TEST(ImproveFaces, SettlingMakesDifferencesSmaller) {
  constexpr double kNoise = 1e-7;
  for (const double x : {1.0, 0.3, 0.05})
    for (const double y : {1.5, 1.9, 1.98})
      for (const double off : {0.1, 0.3, -0.2}) {  // beyond the first line, too
        QuadPatch one = four_quads(x, y, {x + off, y - 0.1, 0}), other = one;
        other.positions[8] += Vec3(kNoise, -kNoise, 0);
        improve_faces(one, board(), FaceGoal::Settled);
        improve_faces(other, board(), FaceGoal::Settled);
        EXPECT_LT((one.positions[8] - other.positions[8]).norm(), kNoise) << x << ' ' << y << ' ' << off;
      }
}

}  // namespace
}  // namespace skinforge
