// Scenes small enough to work out by hand.
#include <gmock/gmock.h>

#include <limits>
#include <numbers>
#include <set>

#include "base/error.h"
#include "io/import.h"
#include "io/trs.h"
#include "testing/posed_points.h"

namespace skinforge {
namespace {

using testing::CharacterPlayer;

constexpr double kRounding = 1e-12;  // a few products in double
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

RawScene::Node node(const std::string& name, std::int32_t parent, const Vec3& translation = Vec3::Zero()) {
  RawScene::Node n;
  n.name = name;
  n.parent = parent;
  n.local.translation = translation;
  return n;
}

Affine3 moved(double x, double y, double z) {
  return Affine3(Eigen::Translation3d(x, y, z));
}

/// The square 0..1 in x and y as two triangles that share no stored vertex.
RawScene::Primitive split_square() {
  RawScene::Primitive p;
  p.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  p.corners = {0, 1, 2, 3, 4, 5};
  p.face_begin = {0, 3, 6};
  return p;
}

void weigh(RawScene::Primitive& p, const std::vector<std::vector<std::pair<int, double>>>& rows) {
  p.weight_begin = {0};
  p.weight_joint.clear();
  p.weight_value.clear();
  for (const auto& row : rows) {
    for (const auto& [joint, weight] : row) {
      p.weight_joint.push_back(joint);
      p.weight_value.push_back(weight);
    }
    p.weight_begin.push_back(static_cast<std::int32_t>(p.weight_joint.size()));
  }
}

/// A square on two joints, "low" at the origin and "high" one up; bound where it stands.
RawScene two_joints() {
  RawScene scene;
  scene.nodes = {node("body", -1), node("low", -1), node("high", 1, {0, 1, 0})};
  scene.nodes[0].mesh = 0;
  scene.nodes[0].skin = 0;
  scene.skins = {{"skin", {1, 2}, {Affine3::Identity(), moved(0, -1, 0)}}};
  RawScene::Primitive p = split_square();
  weigh(p, {{{0, 1.}}, {{0, 1.}}, {{1, 1.}}, {{0, 1.}}, {{1, 1.}}, {{1, 1.}}});
  scene.meshes = {{"square", {p}, {}, {}}};
  return scene;
}

std::set<std::string> codes(const IssueSink& issues) {
  std::set<std::string> found;
  for (const Issue& issue : issues.issues()) found.insert(issue.code);
  return found;
}

RawScene::NodeTracks turned(std::int32_t n, const Quat& q) {
  RawScene::NodeTracks tracks;
  tracks.node = n;
  tracks.rotation = {Interpolation::Linear, {0, 2}, {Quat::Identity(), q}};
  return tracks;
}

TEST(BuildCharacter, WeldsAndKeepsTheJoints) {
  IssueSink issues;
  const Character c = build_character(two_joints(), "square.glb", issues);
  EXPECT_EQ(c.name, "square");
  EXPECT_EQ(c.mesh.vertex_count(), 4u);
  EXPECT_EQ(c.mesh.face_count(), 2u);
  EXPECT_THAT(c.skeleton.names(), ::testing::ElementsAre("low", "high"));
  EXPECT_EQ(c.skeleton[JointId(1)].joint_from_model.matrix(), moved(0, -1, 0).matrix());
  EXPECT_EQ(c.mesh.normals[0], Vec3(0, 0, 1));  // computed: the file has none
  EXPECT_THAT(codes(issues), ::testing::ElementsAre("normals-computed"));
}

TEST(BuildCharacter, VerticesWithOtherWeightsStayApart) {
  RawScene scene = two_joints();
  auto& p = scene.meshes[0].primitives[0];
  p.weight_joint[3] = 1;  // the second (0, 0, 0) moves with the upper joint
  IssueSink issues;
  const Character c = build_character(scene, "square", issues);
  EXPECT_EQ(c.mesh.vertex_count(), 5u);
  EXPECT_TRUE(codes(issues).count("weld-refused"));
}

TEST(BuildCharacter, WeldsFarOut) {
  RawScene scene = two_joints();
  for (Vec3& p : scene.meshes[0].primitives[0].positions) p *= 3e38;
  scene.nodes[2].local.translation *= 3e38;
  scene.skins[0].inverse_bind[1].translation() *= 3e38;
  IssueSink issues;
  const Character c = build_character(scene, "square", issues);
  ASSERT_EQ(c.mesh.vertex_count(), 4u);
  EXPECT_EQ(c.mesh.positions[2], Vec3(3e38, 3e38, 0));
  EXPECT_EQ(c.mesh.face_count(), 2u);
}

// The diagonal of the square overflows, and with it the tolerance.
TEST(BuildCharacter, WeldsNothingThatHasNoSize) {
  RawScene scene = two_joints();
  for (Vec3& p : scene.meshes[0].primitives[0].positions) p *= 1e308;
  IssueSink issues;
  EXPECT_EQ(build_character(scene, "square", issues).mesh.vertex_count(), 6u);
}

TEST(BuildCharacter, CollapsedFacesGo) {
  RawScene scene = two_joints();
  scene.meshes[0].primitives[0].positions[1] = {1e-9, 0, 0};  // nearer to vertex 0 than a millionth
  IssueSink issues;
  const Character c = build_character(scene, "square", issues);
  EXPECT_EQ(c.mesh.face_count(), 1u);
  EXPECT_TRUE(codes(issues).count("faces-collapsed"));
}

// The file shows "high" bent; only its bind matrix knows where it was bound.
TEST(BuildCharacter, RestIsTheBindPoseNotTheDefaultPose) {
  RawScene scene = two_joints();
  const Quat bent(Eigen::AngleAxisd(1, Vec3::UnitZ()));
  scene.nodes[2].local.rotation = bent;
  scene.animations = {{"still", {turned(1, Quat::Identity())}}};
  IssueSink issues;
  const Character c = build_character(scene, "square", issues);
  EXPECT_TRUE(c.skeleton[JointId(1)].bind.rotation.isApprox(Quat::Identity(), kRounding));
  EXPECT_EQ(c.mesh.positions[2], Vec3(1, 1, 0));
  // The clip does not drive "high", so a key holds the file's pose: (1, 1, 0) turns by 1 about (0, 1, 0).
  const auto posed = CharacterPlayer(c).pose(c.clips[0], 0.5);
  EXPECT_LT((posed[2] - Vec3(std::cos(1), 1 + std::sin(1), 0)).norm(), kRounding);
}

TEST(BuildCharacter, KeysStayAsTheyAre) {
  RawScene scene = two_joints();
  RawScene::NodeTracks tracks = turned(2, quaternion_xyzw(0, 0, 0.6, 0.8));
  tracks.translation = {Interpolation::CubicSpline,
                        {0.25, 1},
                        {{1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}, {5, 0, 0}, {6, 0, 0}}};
  tracks.scale = {Interpolation::Step, {0.5}, {{1, 2, 3}}};
  scene.animations = {{"a|b", {tracks}}};
  IssueSink issues;
  const Character c = build_character(scene, "square", issues);
  ASSERT_EQ(c.clips.size(), 1u);
  EXPECT_EQ(c.clips[0].name, "b");
  EXPECT_EQ(c.clips[0].duration, 2);
  ASSERT_EQ(c.clips[0].joints.size(), 1u);
  const JointTracks& kept = c.clips[0].joints[0];
  EXPECT_EQ(kept.translation.interpolation, Interpolation::CubicSpline);
  EXPECT_EQ(kept.translation.values, tracks.translation.values);
  EXPECT_EQ(kept.scale.interpolation, Interpolation::Step);
  EXPECT_EQ(kept.scale.times, tracks.scale.times);
  EXPECT_EQ(kept.rotation.values[1].coeffs(), tracks.rotation.values[1].coeffs());
}

TEST(BuildCharacter, ClipNamesAreUnique) {
  RawScene scene = two_joints();
  for (const char* name : {"a|run", "b|run", "a|walk", "", "", "walk|"})
    scene.animations.push_back({name, {turned(1, Quat::Identity())}});
  IssueSink issues;
  const Character c = build_character(scene, "square", issues);
  std::vector<std::string> names;
  for (const Clip& clip : c.clips) names.push_back(clip.name);
  EXPECT_THAT(names, ::testing::ElementsAre("a|run", "b|run", "walk", "clip", "clip_2", "walk|"));
}

// Centimetres, Z up: 100 units up become 1 metre in Y. Only the top joint takes the change.
TEST(BuildCharacter, LeavesTheUnitsOfTheFile) {
  RawScene scene = two_joints();
  for (auto& p : scene.meshes[0].primitives[0].positions) p = Vec3(100 * p.x(), 0, 100 * p.y());
  scene.nodes[1].local.translation = {0, 0, 50};
  scene.nodes[2].local.translation = {0, 0, 100};
  scene.skins[0].inverse_bind = {moved(0, 0, -50), moved(0, 0, -150)};
  scene.skin_ignores_mesh_node = false;
  scene.metres_from_file = {0.01, Quat(Eigen::AngleAxisd(-std::numbers::pi / 2, Vec3::UnitX())),
                            Vec3::Zero()};
  RawScene::NodeTracks low, high;
  low.node = 1;
  high.node = 2;
  low.translation = {Interpolation::CubicSpline, {0}, {{0, 0, 10}, {0, 0, 70}, {10, 0, 0}}};
  high.translation = {Interpolation::Linear, {0}, {{0, 0, 120}}};
  scene.animations = {{"rise", {low, high}}};
  IssueSink issues;
  const Character c = build_character(scene, "square", issues);
  EXPECT_LT((c.mesh.positions[2] - Vec3(1, 1, 0)).norm(), kRounding);
  const Transform& bind = c.skeleton[JointId(0)].bind;
  EXPECT_LT((bind.translation - Vec3(0, 0.5, 0)).norm(), kRounding);
  EXPECT_NEAR(bind.scale.x(), 0.01, kRounding);
  const auto& keys = c.clips[0].joints[0].translation.values;
  EXPECT_LT((keys[0] - Vec3(0, 0.1, 0)).norm(), kRounding);  // tangent: scaled and turned, not moved
  EXPECT_LT((keys[1] - Vec3(0, 0.7, 0)).norm(), kRounding);
  EXPECT_LT((keys[2] - Vec3(0.1, 0, 0)).norm(), kRounding);
  EXPECT_EQ(c.clips[0].joints[1].translation.values[0], Vec3(0, 0, 120));
  const auto posed = CharacterPlayer(c).pose(c.clips[0], 0);
  EXPECT_LT((posed[0] - Vec3(0, 0.2, 0)).norm(), kRounding);
  EXPECT_LT((posed[2] - Vec3(1, 1.4, 0)).norm(), kRounding);  // up by 0.2 and, below "high", by 0.2 more
}

TEST(BuildCharacter, SeveralRootsGetOneAbove) {
  RawScene scene = two_joints();
  scene.nodes[2].parent = -1;
  scene.nodes[2].name = "root";  // names of the file come first
  IssueSink issues;
  const Character c = build_character(scene, "square", issues);
  EXPECT_THAT(c.skeleton.names(), ::testing::ElementsAre("root_2", "low", "root"));
  EXPECT_EQ(c.skeleton[JointId(2)].parent, JointId(0));
  EXPECT_TRUE(codes(issues).count("root-added"));
}

TEST(BuildCharacter, NamesBecomeUniqueAndPrintable) {
  RawScene scene = two_joints();
  scene.nodes.push_back(node("low", 2));
  scene.nodes.push_back(node("low_2", 2));
  scene.nodes.push_back(node("", 2));
  scene.nodes.push_back(node("\xff", 2));
  IssueSink issues;
  const Character c = build_character(scene, "square", issues);
  EXPECT_THAT(c.skeleton.names(), ::testing::ElementsAre("low", "high", "low_3", "low_2", "node5", "\\xff"));
}

TEST(BuildCharacter, RigidPartsFollowTheirJoint) {
  RawScene scene = two_joints();
  scene.meshes.push_back({"hat", {split_square()}, {}, {}});
  scene.nodes.push_back(node("hat", 2, {0, 0.5, 0}));
  scene.nodes[3].mesh = 1;
  scene.animations = {{"nod", {turned(2, Quat(Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitZ())))}}};
  IssueSink issues;
  const Character c = build_character(scene, "square", issues);
  ASSERT_EQ(c.mesh.vertex_count(), 8u);
  EXPECT_EQ(c.mesh.positions[4], Vec3(0, 1.5, 0));
  EXPECT_EQ(c.weights.of(VertexId(4))[0], (Influence{*c.skeleton.find("hat"), 1.0}));
  const auto posed = CharacterPlayer(c).pose(c.clips[0], 2);
  EXPECT_LT((posed[4] - Vec3(-0.5, 1, 0)).norm(), kRounding);  // (0, 0.5) above "high", turned a quarter
}

TEST(BuildCharacter, StaticMeshHangsOnAnAddedRoot) {
  RawScene scene;
  scene.nodes = {node("stone", -1, {5, 0, 0})};
  scene.nodes[0].mesh = 0;
  scene.meshes = {{"stone", {split_square()}, {}, {}}};
  IssueSink issues;
  const Character c = build_character(scene, "stone.obj", issues);
  EXPECT_THAT(c.skeleton.names(), ::testing::ElementsAre("root"));
  EXPECT_EQ(c.mesh.positions[0], Vec3(5, 0, 0));
}

TEST(BuildCharacter, MirroredPartsAreTurnedOutside) {
  RawScene scene;
  scene.nodes = {node("stone", -1)};
  scene.nodes[0].mesh = 0;
  scene.nodes[0].local.scale = {-1, 1, 1};
  RawScene::Primitive p = split_square();
  p.normals.assign(6, Vec3(0, 0, 1));
  scene.meshes = {{"stone", {p}, {}, {}}};
  IssueSink issues;
  const Character c = build_character(scene, "stone", issues);
  EXPECT_EQ(c.mesh.normals[0], Vec3(0, 0, 1));
  EXPECT_GT(area_normal(c.mesh, FaceId(0)).z(), 0);
}

TEST(BuildCharacter, NormalsGoByTheInverseTranspose) {
  RawScene scene;
  scene.nodes = {node("stone", -1)};
  scene.nodes[0].mesh = 0;
  scene.nodes[0].local.scale = {2, 1, 1};
  RawScene::Primitive p = split_square();
  p.normals.assign(6, Vec3(1, 1, 0).normalized());
  scene.meshes = {{"stone", {p}, {}, {}}};
  IssueSink issues;
  const Character c = build_character(scene, "stone", issues);
  EXPECT_LT((c.mesh.normals[0] - Vec3(1, 2, 0).normalized()).norm(), kRounding);
}

// Rows: 2 -> 1, NaN dropped, a negative one dropped, nothing left: takes its neighbour's.
TEST(BuildCharacter, WeightsAreRepaired) {
  RawScene scene = two_joints();
  auto& p = scene.meshes[0].primitives[0];
  p.weight_begin.clear();
  p.weight_joint.clear();
  p.weight_value.clear();
  weigh(p, {{{0, 2.}}, {{0, kNan}, {1, 0.5}}, {{0, -1.}, {1, 1.}}, {{0, 2.}}, {{1, 1.}}, {{0, kNan}}});
  IssueSink issues;
  const Character c = build_character(scene, "square", issues);
  ASSERT_EQ(c.mesh.vertex_count(), 4u);
  EXPECT_EQ(c.weights.of(VertexId(0))[0], (Influence{JointId(0), 1.0}));
  EXPECT_EQ(c.weights.of(VertexId(1))[0], (Influence{JointId(1), 1.0}));
  EXPECT_EQ(c.weights.of(VertexId(2))[0], (Influence{JointId(1), 1.0}));
  EXPECT_EQ(c.weights.of(VertexId(3)).size(), 1u);
  EXPECT_THAT(codes(issues), ::testing::IsSupersetOf({"weights-normalised", "weights-not-finite",
                                                      "weights-negative", "weights-filled"}));
}

// A second skin that stands 3 to the right in its own space binds the same joints: one common map.
TEST(BuildCharacter, SecondSkinIsBroughtToTheFirst) {
  RawScene scene = two_joints();
  scene.nodes.push_back(node("body2", -1));
  scene.nodes[3].mesh = 1;
  scene.nodes[3].skin = 1;
  scene.meshes.push_back(scene.meshes[0]);
  for (auto& p : scene.meshes[1].primitives[0].positions) p += Vec3(3, 0, 0);
  scene.skins.push_back({"skin2", {1, 2}, {moved(-3, 0, 0), moved(-3, -1, 0)}});
  IssueSink issues;
  const Character c = build_character(scene, "two", issues);
  EXPECT_EQ(c.skeleton.size(), 2u);
  EXPECT_EQ(c.mesh.positions[4], c.mesh.positions[0]);
}

// The second skin binds "high" half a unit lower than the first: a helper carries that bind and moves along.
TEST(BuildCharacter, SecondBindOfAJointGetsAHelper) {
  RawScene scene = two_joints();
  scene.nodes.push_back(node("body2", -1));
  scene.nodes[3].mesh = 1;
  scene.nodes[3].skin = 1;
  scene.meshes.push_back(scene.meshes[0]);
  scene.skins.push_back({"skin2", {1, 2}, {Affine3::Identity(), moved(0, -0.5, 0)}});
  const Quat quarter(Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitZ()));
  scene.animations = {{"bend", {turned(2, quarter)}}};
  IssueSink issues;
  const Character c = build_character(scene, "two", issues);
  EXPECT_THAT(c.skeleton.names(), ::testing::ElementsAre("low", "high", "high_bind2"));
  EXPECT_TRUE(codes(issues).count("second-bind"));
  // (1, 1, 0) as the second skin sees it: joint space (1, 0.5, 0), turned a quarter, at (0, 1, 0).
  const auto posed = CharacterPlayer(c).pose(c.clips[0], 2);
  const auto vertex = c.weights.of(VertexId(6));
  ASSERT_EQ(vertex[0].joint, JointId(2));
  EXPECT_LT((posed[6] - Vec3(-0.5, 2, 0)).norm(), kRounding);
  EXPECT_EQ(c.mesh.positions[6], Vec3(1, 1, 0));
}

// The same at any size: no length is compared with a fixed one.
TEST(BuildCharacter, SecondBindAtAnySize) {
  for (const double size : {1e-9, 1.0, 1e9}) {
    SCOPED_TRACE(size);
    RawScene scene = two_joints();
    scene.nodes.push_back(node("body2", -1));
    scene.nodes[3].mesh = 1;
    scene.nodes[3].skin = 1;
    scene.nodes[2].local.translation *= size;
    for (Vec3& p : scene.meshes[0].primitives[0].positions) p *= size;
    scene.meshes.push_back(scene.meshes[0]);
    scene.skins[0].inverse_bind[1] = moved(0, -size, 0);
    scene.skins.push_back({"skin2", {1, 2}, {Affine3::Identity(), moved(0, -0.5 * size, 0)}});
    IssueSink issues;
    const Character c = build_character(scene, "two", issues);
    EXPECT_THAT(c.skeleton.names(), ::testing::ElementsAre("low", "high", "high_bind2"));
    EXPECT_EQ(c.mesh.positions.size(), 8u);
  }
}

TEST(BuildCharacter, MorphTargetsComeAlong) {
  RawScene scene = two_joints();
  auto& p = scene.meshes[0].primitives[0];
  p.morph_offsets = {std::vector<Vec3>(6, Vec3::Zero())};
  p.morph_offsets[0][2] = p.morph_offsets[0][4] = {0, 0, 1};
  scene.meshes[0].morph_names = {"bump"};
  scene.meshes[0].morph_weights = {0.25};
  RawScene::NodeTracks tracks;
  tracks.node = 0;
  tracks.morph_weights = {Interpolation::Linear, {0, 1}, {{0.0}, {1.0}}};
  scene.animations = {{"grow", {tracks}}};
  IssueSink issues;
  const Character c = build_character(scene, "square", issues);
  ASSERT_EQ(c.morphs.size(), 1u);
  EXPECT_THAT(c.morphs[0].vertices, ::testing::ElementsAre(VertexId(2)));
  EXPECT_EQ(c.morphs[0].default_weight, 0.25);
  EXPECT_EQ(CharacterPlayer(c).pose(c.clips[0], 0.5)[2], Vec3(1, 1, 0.5));
}

TEST(BuildCharacter, WarnsOfWhatIsHardlyMeant) {
  const auto warned = [](const RawScene& scene) {
    IssueSink issues;
    build_character(scene, "odd", issues);
    return codes(issues);
  };
  const RawScene sound = two_joints();
  for (const char* code : {"faces-doubled", "joints-flat", "joints-mirrored", "joints-at-one-place",
                           "weights-merged", "normals-unusable"})
    EXPECT_FALSE(warned(sound).count(code)) << code;
  RawScene scene = sound;
  scene.meshes[0].primitives.push_back(scene.meshes[0].primitives[0]);
  EXPECT_TRUE(warned(scene).count("faces-doubled"));
  scene = sound;
  scene.nodes[2].local.scale.x() = 0;
  EXPECT_TRUE(warned(scene).count("joints-flat"));
  scene.nodes[2].local.scale.x() = -1;
  EXPECT_TRUE(warned(scene).count("joints-mirrored"));
  scene = sound;
  scene.skins[0].inverse_bind[1] = Affine3::Identity();
  EXPECT_TRUE(warned(scene).count("joints-at-one-place"));
  scene = sound;
  weigh(scene.meshes[0].primitives[0],
        {{{0, .5}, {0, .5}}, {{0, 1.}}, {{1, 1.}}, {{0, 1.}}, {{1, 1.}}, {{1, 1.}}});
  EXPECT_TRUE(warned(scene).count("weights-merged"));
  scene = sound;
  scene.meshes[0].primitives[0].normals.assign(6, Vec3::Zero());
  EXPECT_TRUE(warned(scene).count("normals-unusable"));
}

TEST(BuildCharacter, KeyTimesAreSorted) {
  RawScene scene = two_joints();
  RawScene::NodeTracks tracks;
  tracks.node = 2;
  tracks.translation = {Interpolation::Linear, {0, 2, 1, 1}, {{0, 0, 0}, {2, 0, 0}, {9, 0, 0}, {1, 0, 0}}};
  scene.animations = {{"a", {tracks}}};
  IssueSink issues;
  const Character c = build_character(scene, "square", issues);
  EXPECT_THAT(c.clips[0].joints[0].translation.times, ::testing::ElementsAre(0, 1, 2));
  EXPECT_EQ(c.clips[0].joints[0].translation.values[1], Vec3(1, 0, 0));
  EXPECT_TRUE(codes(issues).count("keys-sorted"));
}

TEST(BuildCharacter, BrokenScenesAreRefused) {
  IssueSink issues;
  const auto message = [&](const RawScene& scene) -> std::string {
    try {
      build_character(scene, "x.fbx", issues);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::BadInput);
      return error.what();
    }
    return "accepted";
  };
  RawScene scene = two_joints();
  scene.nodes[1].parent = 2;
  EXPECT_EQ(
      message(scene),
      "x.fbx: node 1: in a cycle, or too many levels deep, the limit is 1024; --limit depth=N raises it");
  scene = two_joints();
  scene.meshes[0].primitives[0].corners[0] = 6;
  EXPECT_EQ(message(scene), "x.fbx: mesh 0: a face uses vertex 6 of 6");
  scene = two_joints();
  scene.meshes[0].primitives[0].positions[0].x() = kNan;
  EXPECT_EQ(message(scene), "x.fbx: mesh 0: a position is not finite");
  scene = two_joints();
  scene.skins[0].inverse_bind[1].linear().setZero();
  EXPECT_EQ(message(scene), "x.fbx: skin 0: an inverse bind matrix cannot be inverted");
  scene = two_joints();
  scene.meshes[0].primitives[0].weight_joint[0] = 2;
  EXPECT_EQ(message(scene), "x.fbx: node \"body\": a weight names joint 2 of 2");
  EXPECT_EQ(message({}), "x.fbx: nothing in it: no mesh, no joint");
}

// Law: a matrix made of TRS comes apart into the same matrix, whatever the signs of its scale.
TEST(Trs, TakesProductsApart) {
  const Quat turn = quaternion_xyzw(0.1, -0.5, 0.3, 0.8).normalized();
  for (const Vec3& scale : {Vec3(1, 2, 3), Vec3(-1, 2, 3), Vec3(-1, -2, 3), Vec3(-1, -2, -3)}) {
    const Transform t{{1, 2, 3}, turn, scale};
    const TrsForm plain = to_trs(t.matrix()), alike = to_trs(t.matrix(), t);
    EXPECT_TRUE(plain.transform.matrix().isApprox(t.matrix(), kRounding));
    EXPECT_LT(plain.error, kRounding);
    EXPECT_TRUE(alike.transform.scale.isApprox(scale, kRounding)) << scale.transpose();
  }
}

TEST(Trs, SaysHowFarItIsFromAShear) {
  Affine3 shear = Affine3::Identity();
  shear.linear()(0, 1) = 0.5;
  EXPECT_GT(to_trs(shear).error, 0.1);
}

}  // namespace
}  // namespace skinforge
