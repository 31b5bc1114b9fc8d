// Junctions of generated limbs: any counts, bends, borders and branches hold the gates of junction.md (c).
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "surface/junction_measures.h"
#include "surface/junction_scene.h"

namespace skinforge {
namespace {

using testing::JunctionScene;
using testing::SceneInput;

constexpr double kReach = 6, kFade = 1.5;  // of a limb from the joint on; half of where it fades; metres

class Dice {
 public:
  explicit Dice(unsigned seed) : engine_(seed) {}
  int pick(int low, int high) {
    return low + static_cast<int>(engine_() % static_cast<unsigned>(high - low + 1));
  }
  double between(double low, double high) { return low + (high - low) * pick(0, 1000) / 1000; }

 private:
  std::mt19937 engine_;
};

// A closed limb along x whose faces are about square. It stays where x is below 0; `ragged`: by how many of
// its edges the weights of single vertices stand off from that.
SceneInput limb(int around, double radius, double ragged, Dice& dice) {
  const double step = 2 * std::numbers::pi * radius / around;
  const int rings = static_cast<int>((kReach + 2 * kFade) / step) + 2;
  SceneInput input;
  input.mesh = testing::closed_tube(rings, around, -kReach, step, radius);
  for (const Vec3& p : input.mesh.positions)
    input.weights.push_back(testing::falling((p.x() + ragged * step * dice.between(-1, 1)) / kFade));
  return input;
}

// A limb that goes on where one along x ends, at an angle of `bend` in a plane that is `turn` off.
SceneInput next_limb(int around, double radius, double ragged, double bend, double turn, Dice& dice) {
  SceneInput input = limb(around, radius, ragged, dice);
  const Eigen::AngleAxisd spin(dice.between(0, 6), Vec3::UnitX());
  const Eigen::AngleAxisd back(std::numbers::pi - bend, Vec3::UnitZ()), plane(turn, Vec3::UnitX());
  for (Vec3& p : input.mesh.positions) p = plane * (back * (spin * p));
  return input;
}

struct Made {
  Junction junction;
  MeshTopology topology;  // of the joined surface
  JunctionMeasures measures;
};

Made made_of(const JunctionScene& scene) {
  Made made{scene.junction(), {}, {}};
  const JoinedSurface joined = assemble_surface(scene.sources, std::vector<Junction>{made.junction});
  made.topology = measure_topology(joined.mesh);
  made.measures = measure_junction(joined, 0, &scene.field.distance);
  return made;
}

// One closed surface, whatever the borders are like.
void expect_watertight(const Made& made) {
  EXPECT_EQ(made.topology.boundary_edges, 0u);
  EXPECT_EQ(made.topology.non_manifold_edges + made.topology.non_manifold_vertices, 0u);
  EXPECT_EQ(made.topology.degenerate_faces, 0u);
  EXPECT_EQ(made.topology.components, 1u);
  EXPECT_EQ(made.topology.euler, 2);
  EXPECT_FALSE(made.junction.faults.any()) << describe(made.junction.faults);
}

double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

double mean_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

void expect_good_quads(const Made& made) {
  EXPECT_EQ(made.junction.rung, JunctionRung::Tube) << made.junction.reason;
  std::size_t edges = 0;
  for (const JunctionLoop& loop : made.junction.loops) edges += loop.positions.size();
  EXPECT_EQ(made.measures.triangles, edges % 2);
  EXPECT_EQ(made.measures.folded_faces, 0u);
  EXPECT_GE(quantile(made.measures.scaled_jacobian, 0), 0.2);
  EXPECT_GE(quantile(made.measures.scaled_jacobian, 0.5), 0.5);
  EXPECT_GE(mean_of(made.measures.scaled_jacobian), 0.85);
  EXPECT_LE(quantile(made.measures.deviation, 0.95), 1);
  EXPECT_LE(quantile(made.measures.deviation, 1), 2.5);
}

class BentLimbs : public ::testing::TestWithParam<unsigned> {
 protected:
  // The two limbs are as thick as each other or one is up to 0.6 times thinner.
  JunctionScene scene(double ragged) const {
    Dice dice(GetParam());
    SceneInput host = limb(dice.pick(6, 60), 1, ragged, dice);
    host.is_host = true;
    const double bend = radians(dice.pick(0, 90)), radius = dice.between(0.6, 1);
    return testing::junction_scene({host, next_limb(dice.pick(6, 60), radius, ragged, bend, 0, dice)});
  }
};

TEST_P(BentLimbs, SmoothBordersHoldAllGates) {
  const JunctionScene scene = this->scene(0);
  ASSERT_EQ(scene.loops.size(), 2u);
  const Made made = made_of(scene);
  expect_watertight(made);
  expect_good_quads(made);
  const auto n = static_cast<int>(scene.loops[0].positions.size()),
             m = static_cast<int>(scene.loops[1].positions.size());
  EXPECT_LE(made.measures.irregular_vertices, static_cast<std::size_t>(std::abs(n - m) + 8));
}

TEST_P(BentLimbs, RaggedBordersStayWatertight) {
  expect_watertight(made_of(scene(0.5)));
}

INSTANTIATE_TEST_SUITE_P(Random, BentLimbs, ::testing::Range(0u, 24u));

class BranchingLimbs : public ::testing::TestWithParam<unsigned> {};

// Two or three limbs in the place of one: three and four borders.
TEST_P(BranchingLimbs, HoldTheGates) {
  Dice dice(GetParam());
  const int branches = 2 + static_cast<int>(GetParam() % 2);
  SceneInput host = limb(dice.pick(12, 48), 1, 0, dice);
  host.is_host = true;
  std::vector<SceneInput> inputs = {host};
  const double bend = radians(dice.pick(45, 60)), turn = dice.between(0, 6);
  for (int b = 0; b < branches; ++b)
    inputs.push_back(next_limb(dice.pick(8, 36), dice.between(0.5, 0.8), 0, bend,
                               turn + 2 * std::numbers::pi * b / branches, dice));
  const JunctionScene scene = testing::junction_scene(inputs);
  ASSERT_EQ(scene.loops.size(), static_cast<std::size_t>(branches) + 1);
  const Made made = made_of(scene);
  expect_watertight(made);
  expect_good_quads(made);
}

INSTANTIATE_TEST_SUITE_P(Random, BranchingLimbs, ::testing::Range(0u, 12u));

}  // namespace
}  // namespace skinforge
