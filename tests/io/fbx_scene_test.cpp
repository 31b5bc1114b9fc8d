#include "io/fbx_scene.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <memory>

#include "base/error.h"

namespace skinforge {
namespace {

constexpr double kRounding = 1e-12;

/// A scene out of text; keeps what the scene refers to.
struct Parsed {
  explicit Parsed(const std::string& text)
      : bytes(reinterpret_cast<const std::byte*>(text.data()),
              reinterpret_cast<const std::byte*>(text.data()) + text.size()),
        file(parse_fbx(bytes)),
        scene(file.root) {}
  Bytes bytes;
  FbxFile file;
  FbxScene scene;
};

const char* const kMesh = R"(
Objects: {
  Model: 1, "Model::hips", "LimbNode" { }
  Model: 2, "Model::knee", "LimbNode" { }
  Geometry: 3, "Geometry::", "Mesh" {
    Vertices: *9 { a: 0,0,0,1,0,0,0,1,0 }
    PolygonVertexIndex: *3 { a: 0,1,-3 }
  }
  Deformer: 4, "Deformer::", "Skin" { }
  Deformer: 5, "SubDeformer::knee", "Cluster" {
    Indexes: *2 { a: 0,2 }
  }
}
Connections: {
  C: "OO",1,0
  C: "OO",2,1
  C: "OO",4,3
  C: "OO",5,4
  C: "OP",2,5, "ignored"
}
)";

std::string with(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

std::string refusal(const std::string& text) {
  const Parsed parsed(text);
  try {
    check_fbx(parsed.scene);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::BadInput);
    return error.what();
  }
  return "nothing was refused";
}

TEST(FbxScene, ObjectsAndLinks) {
  const Parsed parsed(kMesh);
  EXPECT_THAT(parsed.scene.all("Model"), ::testing::ElementsAre(1, 2));
  EXPECT_EQ(parsed.scene.name(2), "knee");
  EXPECT_EQ(parsed.scene.name(77), "");
  EXPECT_EQ(parsed.scene.object(77), nullptr);
  ASSERT_EQ(parsed.scene.sources(1).size(), 1u);
  EXPECT_EQ(parsed.scene.sources(1)[0].object, 2);
  ASSERT_EQ(parsed.scene.targets(2).size(), 2u);
  EXPECT_EQ(parsed.scene.targets(2)[1].property, "ignored");
  EXPECT_TRUE(parsed.scene.targets(77).empty());
}

TEST(FbxScene, AConnectionSaidTwiceIsOne) {
  const Parsed parsed(with(kMesh, "C: \"OO\",2,1", "C: \"OO\",2,1\n C: \"OO\",2,1\n C: \"OP\",2,1, \"p\""));
  EXPECT_EQ(parsed.scene.sources(1).size(), 2u);
  ASSERT_EQ(parsed.scene.targets(2).size(), 3u);
  EXPECT_EQ(parsed.scene.targets(2)[0].times, 2u);
  EXPECT_EQ(parsed.scene.targets(2)[1].times, 1u);
}

TEST(FbxScene, RefusesWhatIsNotThere) {
  EXPECT_EQ(refusal(kMesh), "nothing was refused");
  EXPECT_EQ(refusal(with(kMesh, "0,1,-3", "0,1,-4")), "FBX: a face uses vertex 3 of 3");
  EXPECT_EQ(refusal(with(kMesh, "a: 0,2", "a: 0,3")), "FBX: cluster \"knee\" weights vertex 3 of 3");
  EXPECT_EQ(refusal(with(kMesh, "a: 0,2", "a: 0,-1")), "FBX: cluster \"knee\" weights vertex -1 of 3");
  const std::string larger = R"(Geometry: 6, "Geometry::", "Mesh" {
    Vertices: *12 { a: 0,0,0,1,0,0,0,1,0,1,1,0 }
    PolygonVertexIndex: *3 { a: 0,1,-4 }
  }
  Deformer: 4,)";
  const std::string two =
      with(with(kMesh, "Deformer: 4,", larger), "C: \"OO\",5,4", "C: \"OO\",5,4\n C: \"OO\",4,6");
  EXPECT_EQ(refusal(two), "nothing was refused");
  EXPECT_EQ(refusal(with(two, "a: 0,2", "a: 0,3")), "FBX: cluster \"knee\" weights vertex 3 of 3");
}

TEST(FbxScene, RefusesANodeAboveItself) {
  const std::string message = "FBX: node \"hips\" is its own ancestor";
  EXPECT_EQ(refusal(with(kMesh, "\"OO\",1,0", "\"OO\",1,2")), message);
  EXPECT_EQ(refusal(with(kMesh, "\"OO\",1,0", "\"OO\",1,1")), message);
  EXPECT_EQ(refusal(with(kMesh, "\"OO\",4,3", "\"OO\",1,2")),
            message);  // beside the root, as a second parent
}

/// A chain in which each node hangs twice under the one above: the last is there 2^levels times.
std::string doubling(int levels) {
  std::string objects = "Objects: {\n", links = "Connections: {\n C: \"OO\",1,0\n";
  for (int i = 1; i <= levels + 1; ++i)
    objects += fmt::format(" Model: {}, \"Model::n{}\", \"\" {{ }}\n", i, i);
  for (int i = 2; i <= levels + 1; ++i)
    links += fmt::format(" C: \"OO\",{0},{1}\n C: \"OO\",{0},{1}\n", i, i - 1);
  return objects + "}\n" + links + "}\n";
}

TEST(FbxScene, CopiesOfNodesAreAsManyAsAScenesAtMost) {
  EXPECT_EQ(refusal(doubling(15)), "nothing was refused");  // 65535 nodes
  const std::string message =
      "FBX: with node \"n17\" under each of its parents 131071 nodes, the limit is 65536; --limit nodes=N "
      "raises it";
  EXPECT_EQ(refusal(doubling(16)), message);
  EXPECT_EQ(refusal(doubling(1000)), message);
}

TEST(FbxScene, FrameRate) {
  const std::string text = R"(GlobalSettings: { Properties70: {
    P: "TimeMode", "enum", "", "",11
    P: "CustomFrameRate", "double", "Number", "",12.5
  } })";
  EXPECT_EQ(Parsed("").scene.frame_rate(), 30);
  EXPECT_EQ(Parsed(text).scene.frame_rate(), 24);
  EXPECT_EQ(Parsed(with(text, "\"\",11", "\"\",14")).scene.frame_rate(), 12.5);
}

FbxTransform transform_of(const std::string& properties) {
  const Parsed parsed("Properties70: {\n" + properties + "}\n");
  return FbxTransform(parsed.file.root);
}

Vec3 placed(const FbxTransform& t, const Vec3& degrees, const Vec3& point) {
  return t.local(Vec3::Zero(), degrees, Vec3::Ones()).matrix() * point;
}

// Order XYZ turns about x first: y becomes z, which a turn about z leaves. ZYX: y becomes -x.
TEST(FbxTransform, OrderOfTurns) {
  const Vec3 y = Vec3::UnitY(), degrees(90, 0, 90);
  EXPECT_LT((placed(transform_of(""), degrees, y) - Vec3::UnitZ()).norm(), kRounding);
  const FbxTransform zyx = transform_of("P: \"RotationOrder\", \"enum\", \"\", \"\",5\n");
  EXPECT_LT((placed(zyx, degrees, y) + Vec3::UnitX()).norm(), kRounding);
}

// A quarter turn about z around the pivot (1, 0, 0) takes the origin to (1, -1, 0).
TEST(FbxTransform, RotationPivot) {
  const FbxTransform t = transform_of("P: \"RotationPivot\", \"Vector3D\", \"Vector\", \"\",1,0,0\n");
  EXPECT_TRUE(t.has_pivots());
  EXPECT_FALSE(transform_of("").has_pivots());
  EXPECT_LT((placed(t, {0, 0, 90}, Vec3::Zero()) - Vec3(1, -1, 0)).norm(), kRounding);
}

// Twice as large about the pivot (1, 0, 0): the origin goes to (-1, 0, 0).
TEST(FbxTransform, ScalingPivot) {
  const FbxTransform t = transform_of("P: \"ScalingPivot\", \"Vector3D\", \"Vector\", \"\",1,0,0\n");
  const Transform local = t.local(Vec3::Zero(), Vec3::Zero(), Vec3::Constant(2));
  EXPECT_LT((local.matrix() * Vec3::Zero() - Vec3(-1, 0, 0)).norm(), kRounding);
}

// The pre-rotation stands outside of the turn, the inverse post-rotation inside.
TEST(FbxTransform, PreAndPostRotation) {
  const FbxTransform before = transform_of("P: \"PreRotation\", \"Vector3D\", \"Vector\", \"\",0,0,90\n");
  const FbxTransform after = transform_of("P: \"PostRotation\", \"Vector3D\", \"Vector\", \"\",0,0,90\n");
  EXPECT_LT((placed(before, {90, 0, 0}, Vec3::UnitX()) - Vec3::UnitY()).norm(), kRounding);
  EXPECT_LT((placed(after, {90, 0, 0}, Vec3::UnitX()) + Vec3::UnitZ()).norm(), kRounding);
}

}  // namespace
}  // namespace skinforge
