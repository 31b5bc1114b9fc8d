#include "io/fbx_animation.h"

#include <gmock/gmock.h>

#include "base/error.h"
#include "base/limits.h"

namespace skinforge {
namespace {

constexpr double kRounding = 1e-6;  // slopes come from differences
constexpr double kSecond = 1.0;

/// "hips" moves along x from 0 to 1 within a second, flat at both ends; 30 frames a second.
const char* const kMove = R"(
Objects: {
  Model: 1, "Model::hips", "LimbNode" { }
  AnimationStack: 2, "AnimStack::Walk", "" { }
  AnimationLayer: 3, "AnimLayer::Base", "" { }
  AnimationLayer: 4, "AnimLayer::More", "" { }
  AnimationCurveNode: 5, "AnimCurveNode::T", "" { }
  AnimationCurve: 6, "AnimCurve::", "" {
    KeyTime: *2 { a: 0,46186158000 }
    KeyValueFloat: *2 { a: 0,1 }
    KeyAttrFlags: *1 { a: 8 }
    KeyAttrDataFloat: *4 { a: 0,0,0,0 }
    KeyAttrRefCount: *1 { a: 2 }
  }
  AnimationCurveNode: 7, "AnimCurveNode::T", "" { }
}
Connections: {
  C: "OO",1,0
  C: "OO",3,2
  C: "OO",5,3
  C: "OP",5,1, "Lcl Translation"
  C: "OP",6,5, "d|X"
)";

/// What Assimp makes of it: two keys, joined by a line.
RawScene two_keys() {
  RawScene scene;
  scene.nodes.resize(1);
  scene.nodes[0].name = "hips";
  RawScene::NodeTracks tracks;
  tracks.node = 0;
  tracks.translation.times = {0, kSecond};
  tracks.translation.values = {Vec3::Zero(), Vec3::UnitX()};
  scene.animations.push_back({"Walk", {tracks}});
  return scene;
}

RawScene restored(const std::string& connections) {
  const std::string text = kMove + connections + "}\n";
  const auto* begin = reinterpret_cast<const std::byte*>(text.data());
  const Bytes bytes(begin, begin + text.size());
  const FbxFile file = parse_fbx(bytes);
  RawScene scene = two_keys();
  restore_fbx_curves(FbxScene(file.root), scene);
  return scene;
}

TEST(FbxAnimation, FarKeysBecomeASplineThroughTheFrames) {
  const RawScene scene = restored("");
  const Vec3Track& track = scene.animations[0].nodes[0].translation;
  EXPECT_EQ(track.interpolation, Interpolation::CubicSpline);
  ASSERT_EQ(track.times.size(), 31u);
  ASSERT_EQ(track.values.size(), 3 * 31u);
  for (std::size_t k = 0; k <= 30; ++k) {
    const double x = static_cast<double>(k) / 30;
    EXPECT_NEAR(track.times[k], x, kRounding);
    EXPECT_NEAR(track.values[3 * k + 1].x(), x * x * (3 - 2 * x), kRounding);
    EXPECT_NEAR(track.values[3 * k].x(), 6 * x * (1 - x), kRounding);
    EXPECT_NEAR(track.values[3 * k + 2].x(), 6 * x * (1 - x), kRounding);
  }
  EXPECT_TRUE(scene.animations[0].nodes[0].rotation.times.empty());
  ASSERT_EQ(scene.issues.size(), 1u);
  EXPECT_EQ(scene.issues[0].code, "curves-sampled");
}

/// The code of the one issue with which the two keys were left alone.
std::string left_alone(const std::string& connections) {
  const RawScene scene = restored(connections);
  EXPECT_EQ(scene.animations[0].nodes[0].translation.times.size(), 2u);
  EXPECT_EQ(scene.issues.size(), 1u);
  return scene.issues.empty() ? "" : scene.issues[0].code;
}

// Two layers that drive the same node: their sum is not in either.
TEST(FbxAnimation, SeveralLayersStayAsKeys) {
  EXPECT_EQ(left_alone("C: \"OO\",4,2\nC: \"OO\",7,4\nC: \"OP\",7,1, \"Lcl Translation\"\n"),
            "layers-as-keys");
}

TEST(FbxAnimation, ANodeThatIsNotFoundStaysAsKeys) {
  const std::string text = std::string(kMove) + "}\n";
  const auto* begin = reinterpret_cast<const std::byte*>(text.data());
  const Bytes bytes(begin, begin + text.size());
  const FbxFile file = parse_fbx(bytes);
  RawScene scene = two_keys();
  scene.nodes[0].name = "other";
  restore_fbx_curves(FbxScene(file.root), scene);
  EXPECT_EQ(scene.animations[0].nodes[0].translation.times.size(), 2u);
  ASSERT_EQ(scene.issues.size(), 1u);
  EXPECT_EQ(scene.issues[0].code, "curves-as-keys");
}

// Read once for each way from a stack to a curve, they would be read 10^8 times.
TEST(FbxAnimation, RepeatedConnectionsAreReadOnce) {
  std::string repeated;
  for (int i = 0; i < 100; ++i)
    repeated += "C: \"OO\",3,2\nC: \"OO\",5,3\nC: \"OP\",5,1, \"Lcl Translation\"\nC: \"OP\",6,5, \"d|X\"\n";
  const RawScene scene = restored(repeated);
  EXPECT_EQ(scene.animations[0].nodes[0].translation.values,
            restored("").animations[0].nodes[0].translation.values);
  EXPECT_EQ(scene.issues.size(), 1u);
}

TEST(FbxAnimation, CurvesAreNoLongerThanClips) {
  Limits limits;
  limits.clip = 1;
  set_limits(limits);
  EXPECT_EQ(restored("").issues[0].code, "curves-sampled");
  limits.clip = 0;
  set_limits(limits);
  try {
    restored("");
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "FBX: a curve of 1 s, the limit is 0; --limit clip=N raises it");
  }
  set_limits({});
}

// 31 keys of 33 numbers each.
TEST(FbxAnimation, MoreKeysThanTheLimitStayAsTheyAre) {
  Limits limits;
  limits.keys = 31 * 33;
  set_limits(limits);
  EXPECT_EQ(restored("").animations[0].nodes[0].translation.times.size(), 31u);
  limits.keys = 30 * 33;
  set_limits(limits);
  EXPECT_EQ(left_alone(""), "curves-as-keys");
  EXPECT_THAT(restored("").issues[0].message,
              ::testing::HasSubstr("the limit is 990; --limit keys=N raises it"));
  set_limits({});
}

}  // namespace
}  // namespace skinforge
