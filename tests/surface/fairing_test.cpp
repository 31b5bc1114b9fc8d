#include "surface/fairing.h"

#include <gtest/gtest.h>

#include "surface/chords.h"
#include "surface/remesh.h"
#include "surface/ring_zip.h"
#include "surface/shapes.h"

namespace skinforge {
namespace {

constexpr double kRounding = 1e-9;  // a sparse solve over some dozens of unknowns

// A disc in the plane y = 0 whose border is fixed.
TrianglePatch disc() {
  const std::vector<Vec3> loop = testing::ring(16);
  return remesh(split_chords({loop, fill_loop(loop), loop.size()}), nullptr);
}

// One support per border vertex, further out and lower or higher.
std::vector<Support> supports(const TrianglePatch& patch, double out, double up) {
  std::vector<Support> list;
  for (std::size_t v = 0; v < patch.fixed; ++v)
    list.push_back({static_cast<std::int32_t>(v), (1 + out) * patch.positions[v] + Vec3(0, up, 0)});
  return list;
}

double highest(const TrianglePatch& patch) {
  double height = -1e300;
  for (const Vec3& p : patch.positions) height = std::max(height, p.y());
  return height;
}

TEST(Fair, FlatBorderGivesAFlatDisc) {
  TrianglePatch patch = disc();
  for (std::size_t v = patch.fixed; v < patch.positions.size(); ++v)
    patch.positions[v] += Vec3(0.01, 0.3 * std::sin(double(v)), 0);
  const TrianglePatch faired = fair(patch, {});
  EXPECT_EQ(faired.triangles, patch.triangles);
  for (std::size_t v = 0; v < patch.fixed; ++v) EXPECT_EQ(faired.positions[v], patch.positions[v]);
  for (const Vec3& p : faired.positions) EXPECT_NEAR(p.y(), 0, kRounding);
}

// A plane that goes on outside keeps the disc flat; a wall below lifts it to a dome, a wall above sinks it.
TEST(Fair, SupportsGiveTheSlope) {
  const TrianglePatch patch = disc();
  EXPECT_NEAR(highest(fair(patch, supports(patch, 0.3, 0))), 0, kRounding);
  const TrianglePatch dome = fair(patch, supports(patch, 0, -0.3));
  EXPECT_GT(highest(dome), 0.1);
  const TrianglePatch bowl = fair(patch, supports(patch, 0, 0.3));
  for (std::size_t v = patch.fixed; v < patch.positions.size(); ++v) {
    EXPECT_GT(dome.positions[v].y(), 0);
    EXPECT_NEAR(bowl.positions[v].y(), -dome.positions[v].y(), kRounding);
  }
}

// Law: it follows a rigid motion of everything.
TEST(Fair, FollowsARigidMotion) {
  const TrianglePatch patch = disc();
  const auto list = supports(patch, 0.1, -0.3);
  const auto motion = Eigen::Translation3d(1, 2, 3) * Eigen::AngleAxisd(0.7, Vec3(1, 2, 2) / 3);
  TrianglePatch moved = patch;
  for (Vec3& p : moved.positions) p = motion * p;
  auto moved_list = list;
  for (Support& s : moved_list) s.position = motion * s.position;
  const TrianglePatch faired = fair(patch, list), faired_moved = fair(moved, moved_list);
  for (std::size_t v = 0; v < patch.positions.size(); ++v)
    EXPECT_LT((faired_moved.positions[v] - motion * faired.positions[v]).norm(), kRounding);
}

TEST(Fair, NothingFreeNothingDone) {
  const TrianglePatch triangle{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, 3};
  EXPECT_EQ(fair(triangle, {}).positions, triangle.positions);
}

}  // namespace
}  // namespace skinforge
