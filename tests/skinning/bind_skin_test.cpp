#include "skinning/bind_skin.h"

#include <gmock/gmock.h>

#include "base/error.h"
#include "geometry/solid_voxels.h"
#include "testing/shapes.h"

namespace skinforge {
namespace {

constexpr double kRounding = 1e-12;

/// A chain of joints along x at 0, 1 and 2, the last one only an end.
Skeleton chain() {
  Skeleton skeleton;
  for (int i = 0; i < 3; ++i) {
    Joint joint;
    joint.name = i == 2 ? "tip_end" : "bone" + std::to_string(i);
    if (i > 0) joint.parent = JointId(i - 1);
    joint.bind.translation = Vec3(i > 0 ? 1 : 0, 0, 0);
    joint.joint_from_model.translation() = Vec3(-i, 0, 0);
    skeleton.joints.push_back(joint);
  }
  return skeleton;
}

/// A closed square bar around the chain, `n` rings, and a cube beside its far end that touches nothing.
testing::Soup bar(int n) {
  testing::Soup s;
  for (int i = 0; i <= n; ++i)
    for (const auto& [y, z] : {std::pair(-1, -1), std::pair(1, -1), std::pair(1, 1), std::pair(-1, 1)})
      s.positions.emplace_back(2.0 * i / n, 0.2 * y, 0.2 * z);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < 4; ++j) {
      const int a = 4 * i + j, b = 4 * i + (j + 1) % 4;
      s.triangles.push_back({a, b, b + 4});
      s.triangles.push_back({a, b + 4, a + 4});
    }
  s.triangles.push_back({0, 3, 2});
  s.triangles.push_back({0, 2, 1});
  s.triangles.push_back({4 * n, 4 * n + 1, 4 * n + 2});
  s.triangles.push_back({4 * n, 4 * n + 2, 4 * n + 3});
  return s;
}

testing::Soup bar_and_cube(int n) {
  testing::Soup s = bar(n);
  const int first = static_cast<int>(s.positions.size());
  const testing::Soup cube = testing::cube_soup(0.2);
  for (const Vec3& p : cube.positions) s.positions.push_back(p + Vec3(1.7, 0.5, 0));
  for (auto t : cube.triangles) s.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  return s;
}

double weight_of(const SkinWeights& weights, std::size_t v, int joint) {
  double sum = 0;
  for (const Influence& w : weights.of(VertexId(v)))
    if (w.joint == JointId(joint)) sum += w.weight;
  return sum;
}

void expect_sound(const SkinWeights& weights) {
  for (std::size_t v = 0; v < weights.vertex_count(); ++v) {
    const auto row = weights.of(VertexId(v));
    ASSERT_FALSE(row.empty());
    double sum = 0;
    for (const Influence& w : row) {
      EXPECT_GT(w.weight, 0);
      EXPECT_LE(w.weight, 1 + kRounding);
      sum += w.weight;
    }
    EXPECT_NEAR(sum, 1, kRounding);
  }
}

std::vector<std::string> codes(const IssueSink& issues) {
  std::vector<std::string> all;
  for (const Issue& issue : issues.issues()) all.push_back(issue.code);
  return all;
}

TEST(BoneSegments, FromJointsToTheirChildren) {
  const auto segments = bone_segments(chain());
  ASSERT_EQ(segments.size(), 2u);
  EXPECT_EQ(segments[1].joint, JointId(1));
  EXPECT_EQ(segments[1].b, Vec3(2, 0, 0));
  Skeleton with_hand = chain();
  with_hand.joints[2].name = "hand";  // moves something: carries on by half
  EXPECT_EQ(bone_segments(with_hand)[2].b, Vec3(2.5, 0, 0));
}

// The cube touches no handle: it follows the second bone as a whole.
TEST(BindSkin, LoosePartsGoRigidly) {
  const PolygonMesh mesh = testing::polygon_mesh(bar_and_cube(20));
  BindOptions options;
  options.handles.resize(mesh.vertex_count());
  for (std::size_t v = 0; v < 84; ++v) {
    if (mesh.positions[v].x() < 0.6) options.handles[v] = JointId(0);
    if (mesh.positions[v].x() > 1.4) options.handles[v] = JointId(1);
  }
  IssueSink issues;
  const BoundSkin skin = bind_skin(mesh, chain(), options, "bar", issues);
  expect_sound(skin.weights);
  for (std::size_t v = 84; v < mesh.vertex_count(); ++v) EXPECT_EQ(weight_of(skin.weights, v, 1), 1);
  EXPECT_THAT(codes(issues), ::testing::Contains("bind-parts-rigid"));
}

TEST(BindSkin, HeatReachesEveryPart) {
  const PolygonMesh mesh = testing::polygon_mesh(bar_and_cube(20));
  IssueSink issues;
  const BoundSkin skin = bind_skin(mesh, chain(), {.method = BindMethod::Heat, .handles = {}}, "bar", issues);
  expect_sound(skin.weights);
  EXPECT_GT(weight_of(skin.weights, 0, 0), 0.9);   // far end of the first bone
  EXPECT_GT(weight_of(skin.weights, 80, 1), 0.9);  // of the second
  for (std::size_t ring = 1; ring <= 20; ++ring)   // and no step back between
    EXPECT_GE(weight_of(skin.weights, 4 * ring, 1), weight_of(skin.weights, 4 * ring - 4, 1) - 1e-3);
  for (std::size_t v = 84; v < mesh.vertex_count(); ++v) EXPECT_GT(weight_of(skin.weights, v, 1), 0.9);
}

// A root far below the bar, which only places it: no vertex follows it, by either method.
TEST(BindSkin, ARootOnTheGroundHoldsNothing) {
  Skeleton skeleton = chain();
  for (Joint& joint : skeleton.joints) joint.parent = JointId(joint.parent.value + 1);
  Joint root;
  root.name = "root";
  root.bind.translation = Vec3(0, -1, 0);
  root.joint_from_model.translation() = Vec3(0, 1, 0);
  skeleton.joints[0].bind.translation = Vec3(0, 1, 0);
  skeleton.joints.insert(skeleton.joints.begin(), root);
  const PolygonMesh mesh = testing::polygon_mesh(bar(20));
  for (const BindMethod method : {BindMethod::Heat, BindMethod::Harmonic}) {
    IssueSink issues;
    const BoundSkin skin = bind_skin(mesh, skeleton, {.method = method}, "bar", issues);
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) EXPECT_EQ(weight_of(skin.weights, v, 0), 0);
    EXPECT_THAT(codes(issues), ::testing::Contains("bind-joints-outside"));
  }
}

TEST(BindSkin, InfluencesAreCut) {
  const PolygonMesh mesh = testing::polygon_mesh(bar(20));
  IssueSink issues;
  const BoundSkin skin =
      bind_skin(mesh, chain(), {.method = BindMethod::Heat, .handles = {}, .influences = 1}, "bar", issues);
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) EXPECT_EQ(skin.weights.of(VertexId(v)).size(), 1u);
}

TEST(BindSkin, NamesJointsWithoutHandle) {
  const PolygonMesh mesh = testing::polygon_mesh(bar(20));
  BindOptions options;
  options.handles.assign(mesh.vertex_count(), JointId(0));
  IssueSink issues;
  bind_skin(mesh, chain(), options, "bar", issues);
  EXPECT_THAT(codes(issues), ::testing::ElementsAre("bind-joints-without-handle"));
  EXPECT_THAT(issues.issues()[0].message, ::testing::HasSubstr("bone1"));
}

TEST(BindSkin, RefusesWhatCannotBeBound) {
  IssueSink issues;
  const PolygonMesh mesh = testing::polygon_mesh(bar(4));
  BindOptions nothing;
  nothing.handles.resize(mesh.vertex_count());
  EXPECT_THROW(bind_skin(mesh, chain(), nothing, "bar", issues), Error);
  EXPECT_THROW(bind_skin(PolygonMesh(), chain(), {}, "nothing", issues), Error);
}

// A tube open at both ends has an inside all the same; the way round a U is longer than across.
TEST(SolidVoxels, FillAndWays) {
  const testing::Soup cube = testing::cube_soup();
  const SolidVoxels voxels(cube.positions, cube.triangles, 10);
  EXPECT_GE(voxels.count(), 1000u);
  EXPECT_LE(voxels.count(), 11u * 11 * 11);
  const auto distance = voxels.distances_from(std::vector<Vec3>{{0, 0, 0}});
  const auto across = static_cast<std::size_t>(voxels.nearest({1, 1, 1}));
  EXPECT_NEAR(distance[across], std::sqrt(3.0), 0.15);
  EXPECT_EQ(voxels.nearest({5, 1, 1}), voxels.nearest({1, 1, 1}));
}

}  // namespace
}  // namespace skinforge
