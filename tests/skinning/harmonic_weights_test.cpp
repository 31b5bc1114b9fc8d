#include "skinning/harmonic_weights.h"

#include <gtest/gtest.h>

#include <random>

#include "base/parallel.h"
#include "testing/course.h"
#include "testing/shapes.h"

namespace skinforge {
namespace {

constexpr double kSolved = 1e-13;

struct Strip {
  std::vector<Vec3> positions;
  testing::VertexTriangles triangles;
};

// A flat strip of `n` squares along x, cut into triangles.
Strip strip(int n) {
  Strip s;
  for (int i = 0; i <= n; ++i) {
    s.positions.emplace_back(i, 0, 0);
    s.positions.emplace_back(i, 1, 0);
  }
  for (int i = 0; i < 2 * n; i += 2) {
    s.triangles.push_back({VertexId(i), VertexId(i + 2), VertexId(i + 3)});
    s.triangles.push_back({VertexId(i), VertexId(i + 3), VertexId(i + 1)});
  }
  return s;
}

double weight_of(const SkinWeights& weights, std::size_t v, std::int32_t joint) {
  double sum = 0;
  for (const Influence& w : weights.of(VertexId(v)))
    if (w.joint == JointId(joint)) sum += w.weight;
  return sum;
}

// Held at both ends, natural at the sides: the harmonic function is linear in x.
TEST(HarmonicWeights, LinearOnAStrip) {
  const Strip s = strip(4);
  Handles handles(s.positions.size());
  handles[0] = handles[1] = JointId(5);
  handles[8] = handles[9] = JointId(2);
  const HarmonicWeights w = harmonic_weights(s.positions, s.triangles, handles);
  for (std::size_t v = 0; v < s.positions.size(); ++v) {
    EXPECT_NEAR(weight_of(w.weights, v, 2), s.positions[v].x() / 4, kSolved);
    EXPECT_NEAR(weight_of(w.weights, v, 5), 1 - s.positions[v].x() / 4, kSolved);
  }
  EXPECT_TRUE(w.unreached.empty());
}

// A second strip without handle: nothing fails, its vertices are named.
TEST(HarmonicWeights, NamesPartsWithoutHandle) {
  Strip s = strip(2);
  const Strip loose = strip(1);
  for (const Vec3& p : loose.positions) s.positions.push_back(p + Vec3(0, 5, 0));
  for (auto t : loose.triangles) {
    for (VertexId& v : t) v = VertexId(v.value + 6);
    s.triangles.push_back(t);
  }
  Handles handles(s.positions.size());
  handles[0] = JointId(0);
  handles[5] = JointId(1);
  const HarmonicWeights w = harmonic_weights(s.positions, s.triangles, handles);
  EXPECT_EQ(w.unreached, (std::vector{VertexId(6), VertexId(7), VertexId(8), VertexId(9)}));
  for (std::size_t v = 0; v < 6; ++v)
    EXPECT_NEAR(weight_of(w.weights, v, 0) + weight_of(w.weights, v, 1), 1, kSolved);
}

// Squares of which one is a line, and a third face on an edge: finite, sum 1.
TEST(HarmonicWeights, DegenerateAndNonManifoldFaces) {
  Strip s = strip(3);
  s.triangles.push_back({VertexId(2), VertexId(4), VertexId(6)});  // along x: no area
  s.positions.emplace_back(1.5, 0, 2);
  s.triangles.push_back({VertexId(2), VertexId(4), VertexId(8)});  // third face over an edge
  Handles handles(s.positions.size());
  handles[0] = handles[1] = JointId(0);
  handles[6] = handles[7] = JointId(1);
  const HarmonicWeights w = harmonic_weights(s.positions, s.triangles, handles);
  EXPECT_EQ(w.degenerate, 1u);
  for (std::size_t v = 0; v < s.positions.size(); ++v) {
    EXPECT_TRUE(std::isfinite(weight_of(w.weights, v, 0)));
    EXPECT_NEAR(weight_of(w.weights, v, 0) + weight_of(w.weights, v, 1), 1, kSolved);
  }
}

TEST(HarmonicWeights, LawsOnTheHand) {
  SKINFORGE_NEEDS_SHARED();
  const testing::CourseCase course("hand_sequence");
  const auto& positions = course.mesh.positions;
  const HarmonicWeights w = harmonic_weights(positions, course.triangles, course.handles);
  EXPECT_GT(w.least, -1e-12);
  EXPECT_LT(w.largest, 1 + 1e-12);
  for (std::size_t v = 0; v < positions.size(); ++v) {
    double sum = 0;
    for (const Influence& influence : w.weights.of(VertexId(v))) sum += influence.weight;
    ASSERT_NEAR(sum, 1, kSolved);
  }
  std::vector<Vec3> moved;
  const Quat turn(Eigen::AngleAxisd(0.7, Vec3(1, 2, 2) / 3));
  for (const Vec3& p : positions) moved.push_back(3 * (turn * p) + Vec3(1, 2, 3));
  const HarmonicWeights same = harmonic_weights(moved, course.triangles, course.handles);
  for (std::size_t i = 0; i < w.weights.influences.size(); ++i)
    ASSERT_NEAR(w.weights.influences[i].weight, same.weights.influences[i].weight, 1e-10);
  set_thread_limit(1);
  EXPECT_EQ(harmonic_weights(positions, course.triangles, course.handles).weights.influences,
            w.weights.influences);
  set_thread_limit(2);
}

}  // namespace
}  // namespace skinforge
