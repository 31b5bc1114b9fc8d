#include <gtest/gtest.h>

#include <fstream>

#include "testing/assets.h"
#include "testing/gltf_evaluator.h"
#include "testing/point_index.h"
#include "testing/program.h"
#include "testing/temporary_folder.h"

// recipes/bound_human.json from the outside: a model without bones, bound, corrected and exported, read by an
// evaluator and a validator that share no code with the tool.
namespace skinforge {
namespace {
namespace fs = std::filesystem;
using testing::GltfEvaluator;
using testing::Program;

class BoundHuman : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto run = Program(SKINFORGE_BINARY,
                             {"build", testing::repository_file("recipes/bound_human.json"), "--out", "out",
                              "--cache", "cache", "--report", "json", "-q"},
                             folder_.path())
                         .finish();
    ASSERT_EQ(run.status, 0) << run.err;
  }
  std::string glb_path() const { return (folder_ / "out/bound_human.glb").string(); }

  testing::TemporaryFolder folder_;
};

TEST_F(BoundHuman, TheKhronosValidatorFindsNothing) {
  const auto run =
      Program("/usr/bin/env", {"node", testing::repository_file("scripts/validate_gltf.mjs"), glb_path()},
              fs::temp_directory_path())
          .finish();
  if (run.status == 127 || run.status == 2) GTEST_SKIP() << "NO VALIDATOR: " << run.err;
  EXPECT_EQ(run.status, 0) << run.out << run.err;
}

// Every clip of the hand-skinned original, at ten times; distances in shares of the diagonal. They hold what
// the other weights do and what the correctives do on purpose (up to 1.4 %).
TEST_F(BoundHuman, MovesLikeTheHandSkinnedOriginal) {
  const GltfEvaluator bound(glb_path()), original(testing::repository_file("data/human.glb"));
  const auto rest = bound.bind_pose();
  const testing::PointIndex index(original.bind_pose());
  std::vector<std::size_t> match;
  Eigen::AlignedBox3d box;
  for (const auto& p : rest) {
    match.push_back(index.nearest(p));
    box.extend(p);
  }
  ASSERT_EQ(bound.animation_count(), original.animation_count());
  double largest = 0, sum = 0;
  std::size_t count = 0;
  for (int clip = 0; clip < bound.animation_count(); ++clip)
    for (int i = 0; i < 10; ++i) {
      const double time = bound.duration(clip) * i / 9;
      const auto a = bound.pose(clip, time), b = original.pose(clip, time);
      for (std::size_t v = 0; v < a.size(); ++v) {
        const double distance = (a[v] - b[match[v]]).norm() / box.diagonal().norm();
        largest = std::max(largest, distance);
        sum += distance;
        ++count;
      }
    }
  EXPECT_LT(sum / static_cast<double>(count), 0.002);
  EXPECT_LT(largest, 0.045);
}

}  // namespace
}  // namespace skinforge
