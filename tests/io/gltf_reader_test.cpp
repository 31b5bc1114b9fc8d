#include "io/gltf_reader.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "base/error.h"
#include "testing/assets.h"
#include "testing/glb_file.h"

namespace skinforge {
namespace {

using testing::append_numbers;
using testing::as_input;
using ::testing::ElementsAre;
using testing::glb_bytes;
using ::testing::HasSubstr;

/// A triangle file that tests change: extra JSON goes into the primitive, the root, and the binary chunk.
struct TriangleFile {
  std::string primitive;   ///< members of the primitive behind its attributes
  std::string attributes;  ///< attributes behind POSITION
  std::string nodes = R"({"mesh":0})";
  std::string root;       ///< members of the root
  std::string accessors;  ///< accessors from number 1 on
  std::string views;      ///< views from number 1 on
  Bytes binary;           ///< behind the 36 bytes of the positions

  Bytes bytes() const {
    Bytes data;
    append_numbers<float>(data, {0, 0, 0, 1, 0, 0, 0, 1, 0});
    data.insert(data.end(), binary.begin(), binary.end());
    const std::string json =
        fmt::format(R"({{"asset":{{"version":"2.0"}},"buffers":[{{"byteLength":{}}}],)"
                    R"("bufferViews":[{{"buffer":0,"byteLength":36}}{}],)"
                    R"("accessors":[{{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}}{}],)"
                    R"("meshes":[{{"primitives":[{{"attributes":{{"POSITION":0{}}}{}}}]}}],"nodes":[{}]{}}})",
                    data.size(), views, accessors, attributes, primitive, nodes, root);
    return glb_bytes(json, data);
  }
  RawScene read() const { return read_gltf(as_input("t.glb", bytes())); }
};

std::string message(const std::vector<InputFile>& files) {
  try {
    read_gltf(files);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::BadInput);
    return error.what();
  }
  return "no error";
}
std::string message(const TriangleFile& file) {
  return message(as_input("t.glb", file.bytes()));
}
std::string message_of_json(const std::string& json) {
  return message(as_input("t.gltf", testing::bytes_of(json)));
}

bool has_issue(const RawScene& scene, const std::string& code) {
  for (const Issue& issue : scene.issues)
    if (issue.code == code) return true;
  return false;
}

TEST(GltfReader, ReadsATriangleWithoutIndicesOrNormals) {
  const RawScene scene = TriangleFile().read();
  ASSERT_EQ(scene.meshes.size(), 1u);
  const RawScene::Primitive& primitive = scene.meshes[0].primitives.at(0);
  EXPECT_EQ(primitive.positions[1], Vec3(1, 0, 0));
  EXPECT_TRUE(primitive.normals.empty());
  EXPECT_THAT(primitive.corners, ElementsAre(0, 1, 2));
  EXPECT_THAT(primitive.face_begin, ElementsAre(0, 3));
  EXPECT_TRUE(scene.triangles_only);
  EXPECT_TRUE(scene.metres_from_file.is_identity());
}

TEST(GltfReader, NormalisedIntegersAreDividedByTheirRange) {
  // u8 255 -> 1, 51 -> 0.2; u16 65535 -> 1, 13107 -> 0.2 (section 3.6.2.2).
  TriangleFile file;
  append_numbers<std::uint8_t>(file.binary, {255, 51, 0, 255, 0, 0, 0, 255, 0, 0, 0, 255});
  append_numbers<std::uint16_t>(file.binary, {65535, 13107, 0, 0, 0, 0});
  file.views =
      R"(,{"buffer":0,"byteOffset":36,"byteLength":12},{"buffer":0,"byteOffset":48,"byteLength":12})";
  file.accessors = R"(,{"bufferView":1,"componentType":5121,"normalized":true,"count":3,"type":"VEC4"},)"
                   R"({"bufferView":2,"componentType":5123,"normalized":true,"count":3,"type":"VEC2"})";
  file.attributes = R"(,"COLOR_0":1,"TEXCOORD_1":2)";
  const RawScene scene = file.read();
  const RawScene::Primitive& primitive = scene.meshes[0].primitives[0];
  EXPECT_EQ(primitive.colors[0], Vec4(1, 0.2, 0, 1));
  ASSERT_EQ(primitive.uvs.size(), 2u);  // set 0 is not there and zero
  EXPECT_EQ(primitive.uvs[0][0], Vec2(0, 0));
  EXPECT_EQ(primitive.uvs[1][0], Vec2(1, 0.2));
}

TEST(GltfReader, SignedNormalisedIntegersDoNotPassMinusOne) {
  // s8 -128 and -127 both mean -1.
  TriangleFile file;
  append_numbers<std::int8_t>(file.binary, {-128, -127, 127, 0, 0, 0, 0, 0, 0, 0, 0, 0});
  file.views = R"(,{"buffer":0,"byteOffset":36,"byteLength":12,"byteStride":4})";
  file.accessors = R"(,{"bufferView":1,"componentType":5120,"normalized":true,"count":3,"type":"VEC3"})";
  file.attributes = R"(,"NORMAL":1)";
  EXPECT_EQ(file.read().meshes[0].primitives[0].normals[0], Vec3(-1, -1, 1));
}

TEST(GltfReader, SparseValuesReplaceElements) {
  TriangleFile file;
  append_numbers<std::uint8_t>(file.binary, {1, 0, 0, 0});
  append_numbers<float>(file.binary, {7, 8, 9});
  file.views = R"(,{"buffer":0,"byteOffset":36,"byteLength":1},{"buffer":0,"byteOffset":40,"byteLength":12})";
  file.accessors = R"(,{"componentType":5126,"count":3,"type":"VEC3","sparse":{"count":1,)"
                   R"("indices":{"bufferView":1,"componentType":5121},"values":{"bufferView":2}}})";
  file.primitive = R"(,"targets":[{"POSITION":1}])";
  const RawScene scene = file.read();
  EXPECT_THAT(scene.meshes[0].primitives[0].morph_offsets.at(0),
              ElementsAre(Vec3(0, 0, 0), Vec3(7, 8, 9), Vec3(0, 0, 0)));
}

TEST(GltfReader, StripsAndFansBecomeTrianglesOfOneOrientation) {
  // Vertices 0 1 2 2 0 as a strip: (0 1 2), (1 2 2) and (2 2 0) vanish; as a fan 0 1 2: (1 2 0).
  TriangleFile file;
  append_numbers<std::uint8_t>(file.binary, {0, 1, 2, 2, 0, 0, 0, 0});
  file.views = R"(,{"buffer":0,"byteOffset":36,"byteLength":8})";
  file.accessors = R"(,{"bufferView":1,"componentType":5121,"count":5,"type":"SCALAR"},)"
                   R"({"bufferView":1,"componentType":5121,"count":3,"type":"SCALAR"})";
  file.primitive = R"(,"indices":1,"mode":5)";
  EXPECT_THAT(file.read().meshes[0].primitives[0].corners, ElementsAre(0, 1, 2));
  file.primitive = R"(,"indices":2,"mode":6)";
  EXPECT_THAT(file.read().meshes[0].primitives[0].corners, ElementsAre(1, 2, 0));
}

TEST(GltfReader, PointsAreSkippedWithAWarning) {
  TriangleFile file;
  file.primitive = R"(,"mode":0)";
  const RawScene scene = file.read();
  EXPECT_TRUE(scene.meshes[0].primitives.empty());
  EXPECT_TRUE(has_issue(scene, "primitive-skipped"));
}

TEST(GltfReader, FansOfOneVertexAreOnePolygonUnderFbNgonEncoding) {
  // (0 1 2) (0 2 1): one start, and the second goes on where the first ended: the polygon 0 1 2 1. (1 2 0)
  // starts anew.
  TriangleFile file;
  append_numbers<std::uint8_t>(file.binary, {0, 1, 2, 0, 2, 1, 1, 2, 0, 0, 0, 0});
  file.views = R"(,{"buffer":0,"byteOffset":36,"byteLength":12})";
  file.accessors = R"(,{"bufferView":1,"componentType":5121,"count":9,"type":"SCALAR"})";
  file.primitive = R"(,"indices":1,"extensions":{"FB_ngon_encoding":{}})";
  const RawScene scene = file.read();
  EXPECT_FALSE(scene.triangles_only);
  EXPECT_THAT(scene.meshes[0].primitives[0].face_begin, ElementsAre(0, 4, 7));
  EXPECT_THAT(scene.meshes[0].primitives[0].corners, ElementsAre(0, 1, 2, 1, 1, 2, 0));
}

TEST(GltfReader, KeepsUnsoundWeightsAndDropsZeros) {
  TriangleFile file;
  append_numbers<std::uint8_t>(file.binary, {0, 9, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0});
  append_numbers<float>(file.binary, {std::nanf(""), 0, 0, 0, 2, -0.5F, 0, 0, 0, 0, 0, 0});
  file.views =
      R"(,{"buffer":0,"byteOffset":36,"byteLength":12},{"buffer":0,"byteOffset":48,"byteLength":48})";
  file.accessors = R"(,{"bufferView":1,"componentType":5121,"count":3,"type":"VEC4"},)"
                   R"({"bufferView":2,"componentType":5126,"count":3,"type":"VEC4"})";
  file.attributes = R"(,"JOINTS_0":1,"WEIGHTS_0":2)";
  EXPECT_TRUE(has_issue(file.read(), "weights-without-skin"));
  file.nodes = R"({"mesh":0,"skin":0},{})";
  file.root = R"(,"skins":[{"joints":[0,1]}])";
  const RawScene scene = file.read();
  const RawScene::Primitive& primitive = scene.meshes[0].primitives[0];
  EXPECT_THAT(primitive.weight_begin, ElementsAre(0, 1, 3, 3));
  EXPECT_TRUE(std::isnan(primitive.weight_value[0]));
  EXPECT_EQ(primitive.weight_value[1], 2);
  EXPECT_EQ(primitive.weight_value[2], -0.5);
  EXPECT_TRUE(has_issue(scene, "joint-out-of-range"));  // joint 9 of 2, weight 0
  EXPECT_TRUE(scene.skins.at(0).inverse_bind.empty());  // none given: identity
}

TEST(GltfReader, AMatrixBecomesItsTransform) {
  // Scale 2 3 4, then a quarter turn about z (x -> y), then a step of 5 6 7. Columns: 2y, -3x, 4z.
  TriangleFile file;
  file.nodes = R"({"mesh":0,"matrix":[0,2,0,0,-3,0,0,0,0,0,4,0,5,6,7,1]})";
  const Transform t = file.read().nodes[0].local;
  EXPECT_EQ(t.translation, Vec3(5, 6, 7));
  constexpr double kRounding = 1e-15;  // a few rotations of a singular value decomposition
  EXPECT_TRUE(t.scale.isApprox(Vec3(2, 3, 4), kRounding));
  EXPECT_TRUE(t.rotation.isApprox(Quat(Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitZ())), kRounding));
}

TEST(GltfReader, AMirroringMatrixKeepsItsMirror) {
  TriangleFile file;
  file.nodes = R"({"mesh":0,"matrix":[-1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]})";
  const Affine3 matrix = file.read().nodes[0].local.matrix();
  constexpr double kRounding = 1e-15;
  EXPECT_TRUE(matrix.linear().isApprox(Mat3(Vec3(-1, 1, 1).asDiagonal()), kRounding));
}

TEST(GltfReader, RefusesAShearedMatrix) {
  TriangleFile file;
  file.nodes = R"({"mesh":0,"matrix":[1,0,0,0,0.5,1,0,0,0,0,1,0,0,0,0,1]})";
  EXPECT_THAT(message(file), HasSubstr("/nodes/0/matrix: the matrix has no form"));
  file.nodes = R"({"mesh":0,"matrix":[1,0,0,0.5,0,1,0,0,0,0,1,0,0,0,0,1]})";
  EXPECT_THAT(message(file), HasSubstr("does not end in the row 0 0 0 1"));
}

TEST(GltfReader, TranslatesMaterials) {
  TriangleFile file;
  file.root =
      R"(,"materials":[{"name":"m","pbrMetallicRoughness":{"baseColorFactor":[0.5,0.25,1,0.75],"metallicFactor":0.1},)"
      R"("emissiveFactor":[1,0.5,0],"alphaMode":"MASK","alphaCutoff":0.3,"doubleSided":true,)"
      R"("extensions":{"KHR_materials_unlit":{},"KHR_materials_emissive_strength":{"emissiveStrength":4}}},)"
      R"({"extensions":{"KHR_materials_pbrSpecularGlossiness":{"diffuseFactor":[1,0,0,1],"glossinessFactor":0.75}}}])";
  const RawScene scene = file.read();
  ASSERT_EQ(scene.materials.size(), 2u);
  const Material& m = scene.materials[0];
  EXPECT_EQ(m.name, "m");
  EXPECT_EQ(m.base_color, Vec4(0.5, 0.25, 1, 0.75));
  EXPECT_EQ(m.metallic, 0.1);
  EXPECT_EQ(m.roughness, 1);
  EXPECT_EQ(m.emissive, Vec3(4, 2, 0));
  EXPECT_EQ(m.alpha_mode, AlphaMode::Mask);
  EXPECT_EQ(m.alpha_cutoff, 0.3);
  EXPECT_TRUE(m.double_sided && m.unlit);
  EXPECT_EQ(scene.materials[1].base_color, Vec4(1, 0, 0, 1));
  EXPECT_EQ(scene.materials[1].roughness, 0.25);
  EXPECT_EQ(scene.materials[1].metallic, 0);
  EXPECT_TRUE(has_issue(scene, "material-converted"));
}

/// The triangle with one animation of its node: times and values as given.
TriangleFile animated(const std::vector<float>& times, const std::vector<float>& values,
                      const std::string& path, const std::string& mode) {
  const int width = path == "rotation" ? 4 : 3;
  TriangleFile file;
  append_numbers(file.binary, times);
  append_numbers(file.binary, values);
  file.views = fmt::format(
      R"(,{{"buffer":0,"byteOffset":36,"byteLength":{}}},{{"buffer":0,"byteOffset":{},"byteLength":{}}})",
      4 * times.size(), 36 + 4 * times.size(), 4 * values.size());
  file.accessors = fmt::format(
      R"(,{{"bufferView":1,"componentType":5126,"count":{},"type":"SCALAR"}},{{"bufferView":2,"componentType":5126,"count":{},"type":"VEC{}"}})",
      times.size(), values.size() / width, width);
  file.root =
      fmt::format(R"(,"animations":[{{"name":"a","samplers":[{{"input":1,"output":2,"interpolation":"{}"}}],)"
                  R"("channels":[{{"sampler":0,"target":{{"node":0,"path":"{}"}}}}]}}])",
                  mode, path);
  return file;
}

TEST(GltfReader, KeepsAllThreeInterpolations) {
  const std::vector<float> two = {1, 2, 3, 4, 5, 6};
  const RawScene linear = animated({0, 1}, two, "translation", "LINEAR").read();
  const Vec3Track& track = linear.animations.at(0).nodes.at(0).translation;
  EXPECT_EQ(track.interpolation, Interpolation::Linear);
  EXPECT_THAT(track.times, ElementsAre(0, 1));
  EXPECT_THAT(track.values, ElementsAre(Vec3(1, 2, 3), Vec3(4, 5, 6)));
  const RawScene step = animated({0, 1}, two, "scale", "STEP").read();
  EXPECT_EQ(step.animations[0].nodes[0].scale.interpolation, Interpolation::Step);
  std::vector<float> spline(18, 0.25F);
  const RawScene cubic = animated({0, 1}, spline, "translation", "CUBICSPLINE").read();
  EXPECT_EQ(cubic.animations[0].nodes[0].translation.interpolation, Interpolation::CubicSpline);
  EXPECT_EQ(cubic.animations[0].nodes[0].translation.values.size(), 6u);
}

TEST(GltfReader, RepairsKeysWithAWarning) {
  const RawScene scene = animated({0, 1, 1}, {0, 0, 0, 1, 1, 1, 2, 2, 2}, "translation", "LINEAR").read();
  EXPECT_THAT(scene.animations[0].nodes[0].translation.values, ElementsAre(Vec3(0, 0, 0), Vec3(2, 2, 2)));
  EXPECT_TRUE(has_issue(scene, "key-times-equal"));
  const RawScene turned = animated({0}, {0, 0, 0, 2}, "rotation", "LINEAR").read();
  EXPECT_EQ(turned.animations[0].nodes[0].rotation.values[0].w(), 1);
  EXPECT_TRUE(has_issue(turned, "rotation-normalised"));
}

TEST(GltfReader, RefusesBrokenKeys) {
  EXPECT_THAT(message(animated({0, 2, 1}, std::vector<float>(9), "translation", "LINEAR")),
              HasSubstr("key time 1 follows 2"));
  EXPECT_THAT(message(animated({-1}, {0, 0, 0}, "translation", "LINEAR")),
              HasSubstr("the first key time is -1"));
  EXPECT_THAT(message(animated({0, 1}, {0, 0, 0}, "translation", "LINEAR")),
              HasSubstr("/animations/0/samplers/0/output: 1 elements for 2 key times, wanted 2"));
  EXPECT_THAT(message(animated({0}, {0, 0, 0}, "translation", "SMOOTH")), HasSubstr("is none of LINEAR"));
  EXPECT_THAT(message(animated({0}, {0, 0, 0}, "colour", "LINEAR")),
              HasSubstr("\"colour\" is none of translation"));
  EXPECT_THAT(message(animated({0}, {NAN, 0, 0}, "translation", "LINEAR")),
              HasSubstr("/accessors/2: element 0 is not finite"));
  EXPECT_THAT(message(animated({90'000}, {0, 0, 0}, "translation", "LINEAR")),
              HasSubstr("the limit is 86400; --limit clip=N raises it"));
}

TEST(GltfReader, NamesThePlaceOfBrokenAccessors) {
  TriangleFile file;
  file.accessors = R"(,{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"})";
  EXPECT_EQ(message(file), "t.glb: /accessors/1/count: 4 elements end at byte 48, the view has 36");
  file.accessors = R"(,{"bufferView":0,"componentType":5126,"count":9007199254740991,"type":"MAT4"})";
  EXPECT_THAT(message(file), HasSubstr("t.glb: /accessors/1/count: 9007199254740991 elements"));
  file.accessors = R"(,{"bufferView":7,"componentType":5126,"count":3,"type":"VEC3"})";
  EXPECT_EQ(message(file), "t.glb: /accessors/1/bufferView: refers to buffer view 7, the file has 1");
  file.accessors = R"(,{"bufferView":0,"componentType":5126,"count":-1,"type":"VEC3"})";
  EXPECT_EQ(message(file), "t.glb: /accessors/1/count: found -1, wanted a whole number from 0");
  file.accessors = R"(,{"bufferView":0,"componentType":5126,"count":"3","type":"VEC3"})";
  EXPECT_EQ(message(file), "t.glb: /accessors/1/count: found string, wanted a number");
  file.accessors = "";
  file.views = R"(,{"buffer":0,"byteOffset":30,"byteLength":7})";
  EXPECT_EQ(message(file), "t.glb: /bufferViews/1/byteLength: the view ends at byte 37, its buffer has 36");
}

TEST(GltfReader, RefusesBrokenTrees) {
  TriangleFile file;
  file.nodes = R"({"mesh":0,"children":[1]},{"children":[2]},{"children":[1]})";
  EXPECT_THAT(message(file), HasSubstr("/nodes/2/children/0: node 1 has two parents, 0 and 2"));
  file.nodes = R"({"mesh":0},{"children":[2]},{"children":[1]})";
  EXPECT_THAT(message(file), HasSubstr("/nodes/1: the node is part of a cycle of children"));
  file.nodes = R"({"mesh":0,"children":[0]})";
  EXPECT_THAT(message(file), HasSubstr("node 0 is its own child"));
  file.nodes = R"({"mesh":0,"children":[5]})";
  EXPECT_THAT(message(file), HasSubstr("refers to node 5, the file has 1"));
}

/// `depth` nodes in one chain, the mesh in the first.
std::string chain(int depth) {
  std::string nodes;
  for (int i = 0; i < depth; ++i) {
    nodes += fmt::format(R"({}{{{}{}}})", i > 0 ? "," : "", i == 0 ? R"("mesh":0)" : R"("name":"n")",
                         i + 1 < depth ? fmt::format(R"(,"children":[{}])", i + 1) : "");
  }
  return nodes;
}

TEST(GltfReader, LimitsTheDepthOfTheTree) {
  TriangleFile file;
  file.nodes = chain(1024);
  EXPECT_EQ(file.read().nodes.size(), 1024u);
  file.nodes = chain(1025);
  EXPECT_THAT(message(file), HasSubstr("the node tree is 1025 levels deep here, the limit is 1024"));
}

TEST(GltfReader, RefusesWhatItCannotUnderstand) {
  EXPECT_EQ(message_of_json("{}"), "t.gltf: /: the member \"asset\" is missing");
  EXPECT_THAT(message_of_json(R"({"asset":{"version":"1.0"}})"), HasSubstr("glTF \"1.0\", wanted 2.0"));
  EXPECT_THAT(
      message_of_json(R"({"asset":{"version":"2.0"},"extensionsRequired":["KHR_draco_mesh_compression"]})"),
      HasSubstr("\"KHR_draco_mesh_compression\" is required but not understood"));
  EXPECT_THAT(message_of_json(R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":4}]})"),
              HasSubstr("/buffers/0: has no data"));
  TriangleFile file;
  file.root = R"(,"extensionsUsed":["VENDOR_x"])";
  EXPECT_TRUE(has_issue(file.read(), "extension-ignored"));
}

TEST(GltfReader, NamesBothLengthsOfATruncatedFile) {
  SKINFORGE_NEEDS_SHARED();
  InputFile horse = read_input_file(testing::shared_file("assets/quaternius_horse/horse.glb"));
  horse.path = "horse.glb";
  horse.bytes.resize(20'000);
  EXPECT_EQ(message({horse}),
            "horse.glb: truncated GLB: header says 682356 bytes, file has 20000; copy it anew");
}

}  // namespace
}  // namespace skinforge
