#include <gtest/gtest.h>

#include <random>

#include "base/parallel.h"
#include "deform/dual_quaternion_blend.h"
#include "deform/example_weights.h"
#include "deform/face_rotations.h"
#include "deform/poisson_stitch.h"
#include "deform/unposing.h"
#include "skeleton/rotations.h"
#include "skinning/linear_blend.h"
#include "testing/course.h"
#include "testing/shapes.h"

namespace skinforge {
namespace {

constexpr double kRounding = 1e-13;

/// A knotted tube with random smooth weights of four bones and random motions of them.
struct Scene {
  PolygonMesh mesh = testing::polygon_mesh(testing::torus_knot_soup(40, 8));
  testing::VertexTriangles triangles = triangulate(mesh).triangles;
  SkinWeights weights;
  std::vector<RigidMotion> motions;
  std::vector<VertexId> held{VertexId(0), VertexId(1), VertexId(2)};

  explicit Scene(std::mt19937& random) {
    std::normal_distribution<double> normal;
    for (const Vec3& p : mesh.positions) {
      std::vector<Influence> row;
      for (int k = 0; k < 4; ++k)
        row.push_back({JointId(k), std::exp(std::sin(p.x() + 1.7 * k) + p.y() * 0.3 * k)});
      weights.push_row(normalised_row(row, 3));
    }
    for (int k = 0; k < 4; ++k)
      motions.push_back({from_rotation_vector(0.6 * Vec3(normal(random), normal(random), normal(random))),
                         {normal(random), normal(random), normal(random)}});
  }
  std::vector<Vec3> stitched() const {
    const PoissonStitcher stitcher(mesh.positions, triangles, held);
    std::vector<Mat3> maps;
    for (const Quat& q : FaceBlend(triangles, weights).rotations(testing::rotations_of(motions)))
      maps.push_back(q.toRotationMatrix());
    return stitcher.stitch(maps, linear_blend(mesh.positions, weights, testing::matrices_of(motions)));
  }
  std::array<std::vector<Vec3>, 3> all_methods() const {
    return {linear_blend(mesh.positions, weights, testing::matrices_of(motions)),
            dual_quaternion_blend(mesh.positions, weights, motions), stitched()};
  }
};

double distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double largest = 0;
  for (std::size_t v = 0; v < a.size(); ++v) {
    EXPECT_TRUE(a[v].allFinite() && b[v].allFinite());
    largest = std::max(largest, (a[v] - b[v]).norm());
  }
  return largest;
}

TEST(Deformers, IdentityGivesRest) {
  std::mt19937 random(1);
  Scene scene(random);
  scene.motions.assign(4, RigidMotion());
  for (const auto& posed : scene.all_methods()) EXPECT_LT(distance(posed, scene.mesh.positions), 1e-12);
}

TEST(Deformers, OneBoneIsItsMotion) {
  std::mt19937 random(2);
  Scene scene(random);
  scene.weights = {};
  for (std::size_t v = 0; v < scene.mesh.vertex_count(); ++v)
    scene.weights.push_row(std::vector<Influence>{{JointId(2), 1.0}});
  std::vector<Vec3> rigid;
  for (const Vec3& p : scene.mesh.positions) rigid.push_back(scene.motions[2] * p);
  for (const auto& posed : scene.all_methods()) EXPECT_LT(distance(posed, rigid), 1e-12);
}

TEST(Deformers, SignsOfQuaternionsDoNotMatter) {
  std::mt19937 random(3);
  Scene scene(random);
  const auto before = scene.all_methods();
  scene.motions[1].rotation.coeffs() *= -1;
  scene.motions[3].rotation.coeffs() *= -1;
  const auto after_signs = scene.all_methods();
  for (std::size_t m = 0; m < 3; ++m) EXPECT_LT(distance(before[m], after_signs[m]), kRounding);
}

TEST(Deformers, RigidMotionsGoThrough) {
  std::mt19937 random(4);
  Scene scene(random);
  const auto before = scene.all_methods();
  const RigidMotion on_top{from_rotation_vector({0.4, -1, 2}), {1, -3, 2}};
  for (RigidMotion& motion : scene.motions) motion = after(on_top, motion);
  const auto moved = scene.all_methods();
  for (std::size_t m = 0; m < 3; ++m) {
    std::vector<Vec3> expected;
    for (const Vec3& p : before[m]) expected.push_back(on_top * p);
    EXPECT_LT(distance(moved[m], expected), 1e-11);
  }
}

// Bones by other numbers, weights and motions with them: rows are stored in another order, ties fall
// otherwise.
TEST(Deformers, OrderOfBonesDoesNotMatter) {
  std::mt19937 random(9);
  Scene scene(random);
  const auto before = scene.all_methods();
  const std::array<int, 4> number{2, 0, 3, 1};
  SkinWeights weights;
  for (std::size_t v = 0; v < scene.mesh.vertex_count(); ++v) {
    std::vector<Influence> row;
    for (const Influence& i : scene.weights.of(VertexId(v)))
      row.push_back({JointId(number[i.joint.index()]), i.weight});
    std::reverse(row.begin(), row.end());
    weights.push_row(row);
  }
  std::vector<RigidMotion> motions(4);
  for (std::size_t k = 0; k < 4; ++k) motions[static_cast<std::size_t>(number[k])] = scene.motions[k];
  scene.weights = std::move(weights);
  scene.motions = std::move(motions);
  const auto after_order = scene.all_methods();
  for (std::size_t m = 0; m < 3; ++m) EXPECT_LT(distance(before[m], after_order[m]), 1e-12);
}

TEST(Deformers, SameBitsWithAnyNumberOfThreads) {
  std::mt19937 random(5);
  const Scene scene(random);
  const auto many = scene.all_methods();
  set_thread_limit(1);
  EXPECT_EQ(scene.all_methods(), many);
  set_thread_limit(2);
}

// Half turns about x against none, weights equal: linear blending collapses, the dual quaternions are
// orthogonal, the eigenvalue is double. No answer is right, all must be finite and the same each time.
TEST(Deformers, HalfTurnTiesAreFinite) {
  std::mt19937 random(6);
  Scene scene(random);
  scene.weights = {};
  for (std::size_t v = 0; v < scene.mesh.vertex_count(); ++v)
    scene.weights.push_row(std::vector<Influence>{{JointId(0), 0.5}, {JointId(1), 0.5}});
  scene.motions = {RigidMotion(), {Quat(0, 1, 0, 0), {0, 0, 0}}, RigidMotion(), RigidMotion()};
  const auto first = scene.all_methods(), second = scene.all_methods();
  EXPECT_EQ(first, second);
  for (const auto& posed : first) EXPECT_LT(distance(posed, scene.mesh.positions), 20);
  const auto unposed =
      unpose(scene.mesh.positions, scene.mesh.positions, scene.weights, testing::matrices_of(scene.motions));
  EXPECT_EQ(unposed.damped.size(), scene.mesh.vertex_count());
  for (const Vec3& offset : unposed.offsets) EXPECT_TRUE(offset.allFinite());
}

TEST(DualQuaternionBlend, OppositeHemispheresThatCancel) {
  SkinWeights weights;
  weights.push_row(std::vector<Influence>{{JointId(0), 0.5}, {JointId(1), 0.5}});
  weights.push_row({});
  const std::vector<Vec3> rest{{1, 0, 0}, {4, 5, 6}};
  const std::vector<RigidMotion> motions{{Quat(1, 0, 0, 0), {1, 0, 0}}, {Quat(-1, 0, 0, 0), {1, 0, 0}}};
  const auto posed = dual_quaternion_blend(rest, weights, motions);
  EXPECT_LT((posed[0] - Vec3(2, 0, 0)).norm(), kRounding);
  EXPECT_EQ(posed[1], rest[1]);
}

// Against Eigen's eigensolver, on near and far rotations.
TEST(AverageRotation, AgreesWithTheEigensolver) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 400; ++trial) {
    std::vector<WeightedRotation> terms;
    const double spread = 0.05 + 0.01 * (trial % 100);
    for (int k = 0; k < 1 + trial % 5; ++k)
      terms.push_back({from_rotation_vector(spread * Vec3(normal(random), normal(random), normal(random))),
                       std::abs(normal(random)) + 0.01});
    Eigen::Matrix4d m = Eigen::Matrix4d::Zero();
    for (const auto& t : terms) m += t.weight * t.rotation.coeffs() * t.rotation.coeffs().transpose();
    const Eigen::Vector4d best = average_rotation(terms).coeffs();
    const double value = best.dot(m * best);
    EXPECT_NEAR(best.norm(), 1, kRounding);
    EXPECT_LT((m * best - value * best).norm() / m.trace(), 1e-11) << trial;
    for (int i = 0; i < 20; ++i) {  // no other direction is better
      const Eigen::Vector4d other =
          Eigen::Vector4d(normal(random), normal(random), normal(random), normal(random)).normalized();
      EXPECT_LE(other.dot(m * other), value + kRounding);
    }
  }
}

// A tetrahedron cut off from the held part stands still in its own place instead of anywhere.
TEST(PoissonStitcher, EveryPartIsHeldSomewhere) {
  std::vector<Vec3> positions;
  testing::VertexTriangles triangles;
  for (int part = 0; part < 2; ++part) {
    for (const Vec3& p : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)})
      positions.push_back(p + 5.0 * part * Vec3::UnitX());
    const auto v = [&](int i) { return VertexId(4 * part + i); };
    triangles.insert(triangles.end(),
                     {{v(0), v(2), v(1)}, {v(0), v(1), v(3)}, {v(0), v(3), v(2)}, {v(1), v(2), v(3)}});
  }
  positions.emplace_back(9, 9, 9);  // of no face
  const std::vector<VertexId> held{VertexId(1)};
  const PoissonStitcher stitcher(positions, triangles, held);
  EXPECT_EQ(stitcher.added(), 2u);
  const std::vector<Mat3> maps(triangles.size(), Mat3::Identity());
  EXPECT_LT(distance(stitcher.stitch(maps, positions), positions), 1e-12);
}

TEST(ExampleWeights, GuardsOfItsOwn) {
  const auto point = [](double x) -> Eigen::VectorXd { return Eigen::VectorXd::Constant(1, x); };
  // One pose: always its own. Two examples in one pose: they share.
  EXPECT_EQ(ExampleWeights(std::vector{point(3)})(point(7)), std::vector<double>{1});
  const ExampleWeights shared(std::vector{point(0), point(1), point(1)});
  EXPECT_EQ(shared.distinct(), 2u);
  EXPECT_NEAR(shared(point(1))[1], 0.5, kRounding);
  EXPECT_NEAR(shared(point(0.25))[0], 0.75, kRounding);  // linear between two
  // Far away the Gaussian has nothing left to divide by.
  const ExampleWeights gauss(std::vector{point(0), point(1)}, RadialKernel::Gaussian);
  EXPECT_TRUE(gauss.is_far(point(9)));
  EXPECT_NEAR(gauss(point(9))[1], 81.0 / (81 + 64), kRounding);
}

TEST(Unposing, UndoesLinearBlending) {
  std::mt19937 random(8);
  const Scene scene(random);
  const auto palette = testing::matrices_of(scene.motions);
  std::vector<Vec3> goal = dual_quaternion_blend(scene.mesh.positions, scene.weights, scene.motions);
  const Unposed unposed = unpose(scene.mesh.positions, goal, scene.weights, palette);
  std::vector<Vec3> morphed = scene.mesh.positions;
  for (std::size_t v = 0; v < morphed.size(); ++v) morphed[v] += unposed.offsets[v];
  EXPECT_LT(distance(linear_blend(morphed, scene.weights, palette), goal), 1e-12);
  EXPECT_TRUE(unposed.damped.empty());
}

}  // namespace
}  // namespace skinforge
