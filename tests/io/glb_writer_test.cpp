#include <gmock/gmock.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <map>

#include "io/export.h"
#include "io/gltf_reader.h"
#include "testing/assets.h"
#include "testing/glb_file.h"
#include "testing/gltf_evaluator.h"
#include "testing/temporary_folder.h"
#include "testing/toy_character.h"

namespace skinforge {
namespace {

using testing::as_input;
using ::testing::ElementsAre;

constexpr double kFloat = 2.4e-7;  // two roundings to float of numbers up to 2, and products of them

RawScene read_back(const Character& character, const GlbOptions& options = {}) {
  return read_gltf(as_input("toy.glb", write_glb(character, options)));
}

double as_float(double x) {
  return static_cast<double>(static_cast<float>(x));
}
Vec3 as_float(const Vec3& v) {
  return v.cast<float>().cast<double>();
}

/// Writes the character into a folder and returns the path.
std::string save(const testing::TemporaryFolder& folder, const Bytes& bytes) {
  const std::string path = (folder / "character.glb").string();
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
  return path;
}

/// Polygons as lists of positions, each turned to begin at its least position, all sorted: equal for equal
/// polygons.
using Polygon = std::vector<std::array<float, 3>>;
Polygon canonical(Polygon polygon) {
  std::rotate(polygon.begin(), std::min_element(polygon.begin(), polygon.end()), polygon.end());
  return polygon;
}
std::array<float, 3> triple(const Vec3& p) {
  return {float(p.x()), float(p.y()), float(p.z())};
}

std::vector<Polygon> polygons(const Character& character) {
  std::vector<Polygon> list;
  for (std::size_t f = 0; f < character.mesh.face_count(); ++f) {
    Polygon polygon;
    for (const VertexId v : character.mesh.face(FaceId(f)))
      polygon.push_back(triple(character.mesh.positions[v.index()]));
    list.push_back(canonical(polygon));
  }
  std::sort(list.begin(), list.end());
  return list;
}
std::vector<Polygon> polygons(const RawScene& scene) {
  std::vector<Polygon> list;
  for (const RawScene::Mesh& mesh : scene.meshes)
    for (const RawScene::Primitive& p : mesh.primitives)
      for (std::size_t f = 0; f + 1 < p.face_begin.size(); ++f) {
        Polygon polygon;
        for (int c = p.face_begin[f]; c < p.face_begin[f + 1]; ++c)
          polygon.push_back(triple(p.positions[std::size_t(p.corners[std::size_t(c)])]));
        list.push_back(canonical(polygon));
      }
  std::sort(list.begin(), list.end());
  return list;
}

TEST(GlbWriter, TheToyIsSound) {
  EXPECT_NO_THROW(validate(testing::ToyCharacter::make()));
}

TEST(GlbWriter, PolygonsComeBack) {
  const Character toy = testing::ToyCharacter::make();
  const RawScene scene = read_back(toy);
  EXPECT_FALSE(scene.triangles_only);
  EXPECT_EQ(polygons(scene), polygons(toy));
}

TEST(GlbWriter, WithoutTheEncodingThereAreTriangles) {
  GlbOptions options;
  options.encode_polygons = false;
  const RawScene scene = read_back(testing::ToyCharacter::make(), options);
  EXPECT_TRUE(scene.triangles_only);
  // Six quads, a pentagon, a hexagon, a triangle.
  EXPECT_EQ(polygons(scene).size(), 6u * 2 + 3 + 4 + 1);
}

TEST(GlbWriter, LaysOutJointsMeshesAndSkin) {
  const Character toy = testing::ToyCharacter::make();
  const RawScene scene = read_back(toy);
  ASSERT_EQ(scene.nodes.size(), 5u);
  for (std::size_t j = 0; j < 3; ++j) {
    const Joint& joint = toy.skeleton.joints[j];
    const RawScene::Node& node = scene.nodes[j];
    EXPECT_EQ(node.name, joint.name);
    EXPECT_EQ(node.parent, joint.parent.value);
    EXPECT_EQ(node.local.translation, as_float(joint.bind.translation));
    EXPECT_EQ(node.local.scale, as_float(joint.bind.scale));
    EXPECT_TRUE(node.local.rotation.coeffs().isApprox(joint.bind.rotation.coeffs(), kFloat));
    EXPECT_EQ(scene.skins.at(0).inverse_bind[j].matrix(),
              joint.joint_from_model.matrix().cast<float>().cast<double>());
  }
  EXPECT_THAT(scene.skins[0].joints, ElementsAre(0, 1, 2));
  for (const std::size_t n : {3, 4}) {
    EXPECT_EQ(scene.nodes[n].parent, -1);
    EXPECT_EQ(scene.nodes[n].skin, 0);
    EXPECT_EQ(scene.nodes[n].local.matrix().matrix(), Affine3::Identity().matrix());
  }
  EXPECT_EQ(scene.nodes[3].name, "toy");
  EXPECT_EQ(scene.nodes[4].name, "face");  // has morph targets: a mesh of its own
  EXPECT_TRUE(scene.issues.empty());
}

TEST(GlbWriter, AMeshDoesNotTakeTheNameOfAJoint) {
  Character toy = testing::ToyCharacter::make();
  toy.name = "tip";
  EXPECT_EQ(read_back(toy).nodes[3].name, "tip_mesh");
}

TEST(GlbWriter, DefaultPoseIsTheBindPose) {
  const testing::TemporaryFolder folder;
  Character toy = testing::ToyCharacter::make();
  for (MorphTarget& target : toy.morphs) target.default_weight = 0;
  const testing::GltfEvaluator file(save(folder, write_glb(toy)));
  const auto rest = file.bind_pose(), pose = file.default_pose();
  ASSERT_EQ(rest.size(), pose.size());
  constexpr double kSkinned = 20 * kFloat;  // positions up to 5, three matrices deep
  for (std::size_t v = 0; v < rest.size(); ++v) EXPECT_LE((rest[v] - pose[v]).norm(), kSkinned);
}

TEST(GlbWriter, WeightsAreSortedFloatsThatSumToOne) {
  Character toy = testing::ToyCharacter::make();
  const RawScene scene = read_back(toy);
  std::size_t rows = 0;
  for (const RawScene::Mesh& mesh : scene.meshes)
    for (const RawScene::Primitive& p : mesh.primitives)
      for (std::size_t v = 0; v + 1 < p.weight_begin.size(); ++v, ++rows) {
        const auto* begin = p.weight_value.data() + p.weight_begin[v];
        const auto* end = p.weight_value.data() + p.weight_begin[v + 1];
        EXPECT_NEAR(std::accumulate(begin, end, 0.0), 1, 6e-8);  // half a unit of the last place of 1
        EXPECT_TRUE(std::is_sorted(begin, end, std::greater<>()));
      }
  EXPECT_GT(rows, 24u);
}

/// The toy with six joints below the root, all of which drive every vertex.
Character many_influences() {
  Character toy = testing::ToyCharacter::make();
  for (int i = 0; i < 3; ++i) {
    Joint joint = toy.skeleton.joints[2];
    joint.name += std::to_string(i);
    toy.skeleton.joints.push_back(joint);
  }
  toy.weights = {};
  for (std::size_t v = 0; v < toy.mesh.vertex_count(); ++v)
    toy.weights.push_row(normalised_row({{JointId(0), 0.3},
                                         {JointId(1), 0.25},
                                         {JointId(2), 0.2},
                                         {JointId(3), 0.1},
                                         {JointId(4), 0.1},
                                         {JointId(5), 0.05}}));
  return toy;
}

TEST(GlbWriter, CutsInfluencesToFourOrEight) {
  const Character toy = many_influences();
  const auto four = read_back(toy).meshes[0].primitives[0];
  EXPECT_EQ(four.weight_begin[1], 4);
  EXPECT_NEAR(four.weight_value[0], 0.3 / 0.85, kFloat);
  GlbOptions options;
  options.max_influences = 8;
  const auto eight = read_back(toy, options).meshes[0].primitives[0];
  EXPECT_EQ(eight.weight_begin[1], 6);
  EXPECT_NEAR(eight.weight_value[5], 0.05, kFloat);
}

TEST(GlbWriter, KeysAreKept) {
  const Character toy = testing::ToyCharacter::make();
  const RawScene scene = read_back(toy);
  ASSERT_EQ(scene.animations.size(), 3u);
  EXPECT_EQ(scene.animations[0].name, "bend");
  const auto& bend = scene.animations[0].nodes;
  ASSERT_EQ(bend.size(), 3u);
  EXPECT_EQ(bend[0].node, 1);
  EXPECT_THAT(bend[0].rotation.times, ElementsAre(0, 0.5, 1));
  EXPECT_TRUE(bend[0].rotation.values[1].coeffs().isApprox(toy.clips[0].joints[0].rotation.values[1].coeffs(),
                                                           kFloat));
  EXPECT_EQ(bend[1].translation.interpolation, Interpolation::Step);
  EXPECT_EQ(bend[1].translation.values[1], Vec3(1, 1, 0));
  EXPECT_EQ(bend[2].node, 4);
  EXPECT_THAT(bend[2].morph_weights.values, ElementsAre(ElementsAre(0, 0.5), ElementsAre(1, 0.25)));
  const auto& spline = scene.animations[1].nodes.at(0);
  EXPECT_EQ(spline.translation.interpolation, Interpolation::CubicSpline);
  EXPECT_THAT(spline.translation.times, ElementsAre(as_float(0.1), as_float(0.7)));
  EXPECT_EQ(spline.translation.values.at(2), Vec3(1, 1, 1));
  EXPECT_EQ(spline.scale.values.at(1), Vec3(2, 2, 2));
}

TEST(GlbWriter, AClipWithoutTracksHoldsTheRoot) {
  const RawScene scene = read_back(testing::ToyCharacter::make());
  EXPECT_EQ(scene.animations[2].name, "still");
  const auto& track = scene.animations[2].nodes.at(0).translation;
  EXPECT_THAT(track.times, ElementsAre(0, 2));
  EXPECT_THAT(track.values, ElementsAre(Vec3(0, 0, 0), Vec3(0, 0, 0)));
}

// FBX knows clips of one key that last: the toy's root has a translation there, so its scale is held.
TEST(GlbWriter, AClipOfOneKeyLastsAsLong) {
  Character toy = testing::ToyCharacter::make();
  toy.clips.resize(1);
  Clip& clip = toy.clips[0];
  clip = {"pose", 1.5, {{JointId(0), {Interpolation::Linear, {0}, {Vec3(1, 2, 3)}}, {}, {}}}, {}};
  const RawScene scene = read_back(toy);
  ASSERT_EQ(scene.animations.at(0).nodes.size(), 1U);
  const RawScene::NodeTracks& tracks = scene.animations[0].nodes[0];
  EXPECT_THAT(tracks.translation.times, ElementsAre(0));
  EXPECT_THAT(tracks.scale.times, ElementsAre(0, 1.5));
  EXPECT_EQ(tracks.scale.values[0], tracks.scale.values[1]);
  EXPECT_EQ(tracks.scale.values[0], toy.skeleton.joints[0].bind.scale);
}

TEST(GlbWriter, ClipsMoveToStartAtZeroAndTimesStayDistinct) {
  Character toy = testing::ToyCharacter::make();
  toy.clips.resize(1);
  // In float 16777216.5 is 16777216; the second of the two keys goes.
  toy.clips[0].joints = {
      {JointId(1), {Interpolation::Linear, {-1, 0}, {Vec3(0, 0, 0), Vec3(1, 0, 0)}}, {}, {}},
      {JointId(2),
       {Interpolation::Linear, {0, 16777215, 16777215.5}, {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0)}},
       {},
       {}}};
  toy.clips[0].morphs.clear();
  const testing::TemporaryFolder folder;
  const auto json = testing::GltfEvaluator(save(folder, write_glb(toy))).json();
  const auto& samplers = json["animations"][0]["samplers"];
  const auto& first = json["accessors"][samplers[0]["input"].get<int>()];
  EXPECT_EQ(first["min"][0], 0);
  EXPECT_EQ(first["max"][0], 1);
  EXPECT_EQ(json["accessors"][samplers[1]["input"].get<int>()]["count"], 2);
}

TEST(GlbWriter, MaterialsAndImagesComeBack) {
  const Character toy = testing::ToyCharacter::make();
  const RawScene scene = read_back(toy);
  ASSERT_EQ(scene.images.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(scene.images[i].bytes, toy.images[i].bytes);
    EXPECT_EQ(scene.images[i].name, toy.images[i].name);
  }
  ASSERT_EQ(scene.materials.size(), 2u);
  for (std::size_t m = 0; m < 2; ++m)  // all numbers of the toy's materials are exact in float
    EXPECT_EQ(to_bytes(scene.materials[m]), to_bytes(toy.materials[m])) << toy.materials[m].name;
}

TEST(GlbWriter, CornersComeBackWithTheirAttributes) {
  const Character toy = testing::ToyCharacter::make();
  const RawScene scene = read_back(toy);
  // Material 1 covers quads 2 to 5: 16 corners that differ in normal or colour.
  ASSERT_EQ(scene.meshes[0].primitives.size(), 2u);
  const RawScene::Primitive& p = scene.meshes[0].primitives[1];
  ASSERT_EQ(p.positions.size(), 16u);
  for (std::size_t v = 0; v < 16; ++v) {
    const std::size_t corner = 8 + v;  // vertices are written in the order of their corners
    EXPECT_EQ(p.positions[v], toy.mesh.positions[toy.mesh.corners[corner].index()]);
    EXPECT_EQ(p.normals[v], toy.mesh.normals[corner]);
    EXPECT_EQ(p.uvs.at(0)[v], toy.mesh.uvs[0][corner]);
    EXPECT_EQ(p.colors[v], toy.mesh.colors[corner].cast<float>().cast<double>());
  }
}

// "body" gets a second UV set, on which a texture lies; "face" has none.
TEST(GlbWriter, SeveralUvSetsComeBack) {
  Character toy = testing::ToyCharacter::make();
  toy.mesh.parts[0].uv_sets = 2;
  toy.mesh.uvs.push_back(toy.mesh.uvs[0]);
  for (std::size_t c = 0; c < 24; ++c) toy.mesh.uvs[1][c] = Vec2(0.125 * double(c), 1 - 0.25 * double(c));
  toy.materials[1].normal_texture->uv_set = 1;
  const RawScene scene = read_back(toy);
  const RawScene::Primitive& p = scene.meshes[0].primitives[1];
  ASSERT_EQ(p.uvs.size(), 2u);
  for (std::size_t v = 0; v < 16; ++v)
    for (std::size_t set = 0; set < 2; ++set) EXPECT_EQ(p.uvs[set][v], toy.mesh.uvs[set][8 + v]);
  EXPECT_EQ(scene.materials[1].normal_texture->uv_set, 1);
  EXPECT_EQ(scene.materials[1].base_color_texture->uv_set, 0);
  EXPECT_TRUE(scene.meshes[1].primitives[0].uvs.empty());
}

TEST(GlbWriter, MorphTargetsComeBack) {
  const Character toy = testing::ToyCharacter::make();
  const RawScene::Mesh mesh = read_back(toy).meshes.at(1);
  EXPECT_THAT(mesh.morph_names, ElementsAre("smile", "frown"));
  EXPECT_THAT(mesh.morph_weights, ElementsAre(0.25, 0));
  const RawScene::Primitive& p = mesh.primitives.at(0);
  ASSERT_EQ(p.positions.size(), 11u);  // the triangle uses vertices of the hexagon
  EXPECT_EQ(p.morph_offsets.at(0)[0], Vec3(0, 0.5, 0));
  EXPECT_EQ(p.morph_offsets[0][3], Vec3(0, 0, -1));
  EXPECT_EQ(p.morph_offsets[0][1], Vec3(0, 0, 0));
  EXPECT_EQ(p.morph_offsets.at(1)[1], Vec3(0.125, 0, 0));
}

TEST(GlbWriter, AZeroNormalBecomesThatOfTheFace) {
  Character toy = testing::ToyCharacter::make();
  const Vec3 wanted = toy.mesh.normals[8];
  for (std::size_t c = 8; c < 12; ++c) toy.mesh.normals[c].setZero();
  EXPECT_EQ(read_back(toy).meshes[0].primitives[1].normals[0], wanted);
}

TEST(GlbWriter, EqualCharactersGiveEqualBytes) {
  GlbOptions options;
  options.extras_json = R"({"recipe":"abc","scale":0.1})";
  const Bytes once = write_glb(testing::ToyCharacter::make(), options);
  EXPECT_EQ(once, write_glb(testing::ToyCharacter::make(), options));
  const testing::TemporaryFolder folder;
  const auto json = testing::GltfEvaluator(save(folder, once)).json();
  EXPECT_EQ(json["asset"]["extras"]["skinforge"]["scale"], 0.1);
  EXPECT_EQ(json["asset"]["generator"], "SkinForge");
}

TEST(GlbWriter, TangentsFollowGrowingU) {
  const testing::TemporaryFolder folder;
  const auto path = save(folder, write_glb(testing::ToyCharacter::make()));
  const auto json = testing::GltfEvaluator(path).json();
  const auto& attributes = json["meshes"][0]["primitives"][1]["attributes"];
  ASSERT_TRUE(attributes.contains("TANGENT"));
  const auto& accessor = json["accessors"][attributes["TANGENT"].get<int>()];
  const auto& view = json["bufferViews"][accessor["bufferView"].get<int>()];
  const RawScene unused = read_gltf(read_input_files(path));  // the reader accepts the attribute
  const Bytes file = read_input_file(path).bytes;
  std::uint32_t json_length = 0;
  std::memcpy(&json_length, file.data() + 12, 4);
  float tangent[4];
  std::memcpy(tangent, file.data() + 28 + json_length + view.value("byteOffset", 0), sizeof tangent);
  // Quad 2 is 0 1 5 4 with UVs (0,1) (1,1) (1,0) (0,0): u grows along x, v (down) against z, which is not
  // mirrored.
  EXPECT_THAT(tangent, ElementsAre(1, 0, 0, 1));
}

/// A flat strip of `count` quads, every vertex bound to one joint of a chain of `joints`.
Character strip(int count, int joints) {
  Character c;
  c.name = "strip";
  for (int j = 0; j < joints; ++j) {
    Joint joint;
    joint.name = "j" + std::to_string(j);
    joint.parent = JointId(j - 1);
    c.skeleton.joints.push_back(joint);
  }
  c.mesh.face_begin = {0};
  c.mesh.parts.push_back({"strip", 0, true, false});
  for (int i = 0; i <= count; ++i)
    for (int side = 0; side < 2; ++side) {
      c.mesh.positions.push_back(Vec3(i, side, 0));
      const std::vector<Influence> row = {{JointId(i % joints), 1}};
      c.weights.push_row(row);
    }
  for (int i = 0; i < count; ++i) {
    for (const int v : {2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1}) {
      c.mesh.corners.push_back(VertexId(v));
      c.mesh.normals.push_back(Vec3::UnitZ());
    }
    c.mesh.face_begin.push_back(4 * (i + 1));
    c.mesh.face_material.push_back(MaterialId());
    c.mesh.face_part.push_back(PartId(0));
  }
  return c;
}

std::pair<int, int> index_and_joint_types(const Character& character) {
  const testing::TemporaryFolder folder;
  const auto json = testing::GltfEvaluator(save(folder, write_glb(character))).json();
  const auto& primitive = json["meshes"][0]["primitives"][0];
  return {json["accessors"][primitive["indices"].get<int>()]["componentType"],
          json["accessors"][primitive["attributes"]["JOINTS_0"].get<int>()]["componentType"]};
}

TEST(GlbWriter, TakesTheShortestTypesThatFit) {
  EXPECT_EQ(index_and_joint_types(strip(10, 256)), std::pair(5123, 5121));
  EXPECT_EQ(index_and_joint_types(strip(10, 257)), std::pair(5123, 5123));
  EXPECT_EQ(index_and_joint_types(strip(32'766, 2)), std::pair(5123, 5121));  // 65534 vertices
  EXPECT_EQ(index_and_joint_types(strip(32'767, 2)), std::pair(5125, 5121));  // 65536 vertices
}

TEST(GlbWriter, ALongStripOfQuadsComesBack) {
  const Character long_strip = strip(500, 3);
  EXPECT_EQ(polygons(read_back(long_strip)), polygons(long_strip));
}

/// Findings of the Khronos validator; none when it is not installed.
std::optional<std::pair<int, std::string>> khronos_findings(const std::vector<std::string>& files) {
  if (std::system("node --version > /dev/null 2>&1") != 0) return std::nullopt;
  const testing::TemporaryFolder folder;
  const std::string log = (folder / "findings.txt").string();
  std::string command = "node '" + testing::repository_file("scripts/validate_gltf.mjs") + "'";
  for (const std::string& file : files) command += " '" + file + "'";
  const int status = std::system((command + " > '" + log + "' 2>&1").c_str());
  if (WEXITSTATUS(status) == 2) return std::nullopt;
  std::ifstream text(log);
  return std::pair(WEXITSTATUS(status), std::string(std::istreambuf_iterator<char>(text), {}));
}

TEST(GlbWriter, TheKhronosValidatorFindsNothing) {
  const testing::TemporaryFolder folder;
  std::vector<std::string> files;
  const auto add = [&](const std::string& name, const Bytes& bytes) {
    files.push_back((folder / name).string());
    std::ofstream(files.back(), std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
  };
  GlbOptions plain;
  plain.encode_polygons = false;
  plain.max_influences = 8;
  plain.extras_json = R"({"a":[1,2]})";
  add("toy.glb", write_glb(testing::ToyCharacter::make()));
  add("plain.glb", write_glb(many_influences(), plain));
  add("strip.glb", write_glb(strip(50, 300)));
  const auto findings = khronos_findings(files);
  if (!findings)
    GTEST_SKIP() << "NO KHRONOS VALIDATOR: npm install gltf-validator into build/node, or set NODE_PATH";
  EXPECT_EQ(findings->second, "");
  EXPECT_EQ(findings->first, 0);
}

}  // namespace
}  // namespace skinforge
