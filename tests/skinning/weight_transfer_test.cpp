#include "skinning/weight_transfer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "skinning/linear_blend.h"
#include "skinning/tube_scene.h"
#include "skinning/weight_rows.h"

namespace skinforge {
namespace {

using ::testing::ElementsAre;
using testing::replaced_tubes;
using testing::TubeScene;

constexpr double kRounding = 1e-9;  // the shares come from a sparse solve

VertexId ring_vertex(int ring) {
  return VertexId(ring * TubeScene::kAround);
}

double weight_on(const SkinWeights& weights, VertexId v, int joint) {
  for (const Influence& i : weights.of(v))
    if (i.joint == JointId(joint)) return i.weight;
  return 0;
}

TransferredWeights transfer(const TubeScene& scene, const WeightTransferOptions& options = {}) {
  const auto sources = scene.surfaces();
  return transfer_weights(scene.surface(), sources, junction_shares(scene.surface(), sources), options);
}

// By hand, at x = 0: shares 1/2 and 1/2. Source 0 there: body 0.25, fused 0.75. Source 1 there: fused 0.75,
// tip 0.25. So body 0.125, fused 0.75, tip 0.125.
TEST(TransferWeights, BlendsRetargetedRows) {
  const auto result = transfer(replaced_tubes(), {.smoothing_passes = 0});
  const VertexId middle = ring_vertex(5);
  EXPECT_NEAR(weight_on(result.weights, middle, 0), 0.125, kRounding);
  EXPECT_NEAR(weight_on(result.weights, middle, 1), 0.75, kRounding);
  EXPECT_NEAR(weight_on(result.weights, middle, 2), 0.125, kRounding);
}

TEST(TransferWeights, PreservedVerticesKeepTheArtistsRow) {
  const TubeScene scene = replaced_tubes();
  const auto result = transfer(scene);
  for (std::size_t v = 0; v < scene.origins.size(); ++v) {
    const VertexOrigin origin = scene.origins[v];
    if (origin.is_new()) continue;
    const auto& source = scene.sources[origin.source.index()];
    const auto expected = retargeted_row(source.weights.of(origin.vertex), source.map);
    const auto row = result.weights.of(VertexId(v));
    EXPECT_TRUE(std::equal(row.begin(), row.end(), expected.begin(), expected.end())) << "vertex " << v;
  }
}

TEST(TransferWeights, RowsSumToOneWithinTheLimit) {
  const TubeScene scene = replaced_tubes();
  const auto result = transfer(scene, {.influences = 2});
  for (std::size_t v = 0; v < scene.origins.size(); ++v) {
    const auto row = result.weights.of(VertexId(v));
    double sum = 0;
    for (const Influence& i : row) sum += i.weight;
    EXPECT_NEAR(sum, 1, kRounding);
    EXPECT_LE(row.size(), 2u);  // the sources have no longer rows
  }
}

// Weights that turn over within one edge of source 0 make a step of 2 in the junction; smoothing spreads it.
TEST(TransferWeights, SmoothingLowersTheLargestStep) {
  TubeScene scene = replaced_tubes();
  SkinWeights hard;
  for (const Vec3& p : scene.sources[0].mesh.positions)
    hard.push_row(testing::two_joint_row(p.x() < -0.5 ? 1 : 0));
  scene.sources[0].weights = hard;
  const auto result = transfer(scene);
  EXPECT_LT(result.steps.junction, 0.8 * result.blended.junction);
  EXPECT_EQ(result.steps.neighbours, result.blended.neighbours) << "preserved rows stand still";
}

// The reason for smoothing: rigid rows on both sides (body up to x = 0, tip from there on) and a tip turned
// by 40 degrees. The longest edge of the junction must be stretched less with smoothing than without.
TEST(TransferWeights, SmoothingStretchesLessInMotion) {
  TubeScene scene = replaced_tubes();
  for (int k = 0; k < 2; ++k) {
    SkinWeights rigid;
    for (std::size_t v = 0; v < scene.sources[k].mesh.positions.size(); ++v)
      rigid.push_row(testing::two_joint_row(k == 0 ? 1 : 0));
    scene.sources[k].weights = rigid;
    for (double& p : scene.sources[k].presence) p = p > 0.5 ? 1 : 0;  // a hard cut: the shares jump, too
  }
  std::vector<Affine3> palette(3, Affine3::Identity());
  palette[2].linear() = Eigen::AngleAxisd(radians(40), Vec3::UnitX()).toRotationMatrix();
  const auto longest_stretch = [&](const SkinWeights& weights) {
    const auto posed = linear_blend(scene.result.positions, weights, palette);
    double longest = 0;
    for (std::size_t v = 0; v < posed.size(); ++v)
      for (const VertexId u : scene.graph.of(VertexId(v)))
        longest =
            std::max(longest, (posed[v] - posed[u.index()]).norm() /
                                  (scene.result.positions[v] - scene.result.positions[u.index()]).norm());
    return longest;
  };
  const double rough = longest_stretch(transfer(scene, {.smoothing_passes = 0}).weights);
  const double smooth = longest_stretch(transfer(scene).weights);
  EXPECT_LT(smooth - 1, 0.5 * (rough - 1));
}

// By hand: the rings x = -2 and x = -1 of the preserved part and the junction differ most by what
// `weight_steps` says.
TEST(WeightSteps, MeasuresBothSides) {
  const TubeScene scene = replaced_tubes();
  SkinWeights weights;
  for (const Vec3& p : scene.result.positions) {
    const double first = p.x() < -2.5 ? 1.0 : p.x() < 0.5 ? 0.9 : 0.6;
    weights.push_row(testing::two_joint_row(first));
  }
  const WeightSteps steps = weight_steps(weights, scene.surface());
  EXPECT_NEAR(steps.neighbours, 0.2, kRounding);  // between x = -3 and x = -2
  EXPECT_NEAR(steps.junction, 0.6, kRounding);    // between x = 0 and x = 1
}

// Source 0 has no weights at all near the cut: the rows come from the neighbours, none stays empty.
TEST(TransferWeights, EmptyRowsTakeTheNearestRow) {
  TubeScene scene = replaced_tubes();
  SkinWeights holes;
  for (const Vec3& p : scene.sources[0].mesh.positions) {
    if (p.x() < -3.5)
      holes.push_row(testing::two_joint_row(1));
    else
      holes.push_row({});
  }
  scene.sources[0].weights = holes;
  const auto result = transfer(scene, {.smoothing_passes = 0});
  EXPECT_EQ(result.filled_rows, 2u * TubeScene::kAround);  // the preserved rings x = -3 and x = -2
  EXPECT_THAT(result.weights.of(ring_vertex(2)), ElementsAre(Influence{JointId(0), 1.0}));
  for (std::size_t v = 0; v < scene.origins.size(); ++v) EXPECT_FALSE(result.weights.of(VertexId(v)).empty());
}

TEST(TransferWeights, NoWeightsAnywhereGivesTheRoot) {
  TubeScene scene = replaced_tubes();
  for (auto& source : scene.sources) {
    source.weights = {};
    for (std::size_t v = 0; v < source.mesh.positions.size(); ++v) source.weights.push_row({});
  }
  const auto result = transfer(scene);
  EXPECT_THAT(result.weights.of(ring_vertex(5)), ElementsAre(Influence{JointId(0), 1.0}));
}

}  // namespace
}  // namespace skinforge
