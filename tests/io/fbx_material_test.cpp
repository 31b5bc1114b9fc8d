// Materials of FBX files: a triangle with one material, and the shared assets.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <map>
#include <set>

#include "io/sandbox.h"
#include "testing/assets.h"

namespace skinforge {
namespace {

constexpr double kFloat = 1e-6;  // colours are doubles in the file and floats in Assimp
constexpr double kGrey = 0.8;    // the default of the format

RawScene triangle_with(const std::string& properties) {
  const std::string text = fmt::format(R"(; FBX 7.4.0 project file
FBXHeaderExtension:  {{
  FBXHeaderVersion: 1003
  FBXVersion: 7400
}}
GlobalSettings:  {{
  Version: 1000
}}
Objects:  {{
  Geometry: 1, "Geometry::flat", "Mesh" {{
    Vertices: *9 {{ a: 0,0,0,1,0,0,0,1,0 }}
    PolygonVertexIndex: *3 {{ a: 0,1,-3 }}
    GeometryVersion: 124
    LayerElementMaterial: 0 {{
      Version: 101
      Name: ""
      MappingInformationType: "AllSame"
      ReferenceInformationType: "IndexToDirect"
      Materials: *1 {{ a: 0 }}
    }}
    Layer: 0 {{
      Version: 100
      LayerElement:  {{
        Type: "LayerElementMaterial"
        TypedIndex: 0
      }}
    }}
  }}
  Model: 2, "Model::flat", "Mesh" {{
    Version: 232
  }}
  Material: 3, "Material::paint", "" {{
    Version: 102
    ShadingModel: "phong"
    MultiLayer: 0
    Properties70:  {{
{}    }}
  }}
}}
Connections:  {{
  C: "OO",2,0
  C: "OO",1,2
  C: "OO",3,2
}}
)",
                                       properties);
  const auto* begin = reinterpret_cast<const std::byte*>(text.data());
  return read_in_child({{"flat.fbx", Bytes(begin, begin + text.size()), {}}});
}

std::string color(const std::string& name, const std::string& rgb) {
  return "P: \"" + name + "\", \"Color\", \"\", \"A\"," + rgb + "\n";
}

std::string number(const std::string& name, const std::string& value) {
  return "P: \"" + name + "\", \"Number\", \"\", \"A\"," + value + "\n";
}

Material paint(const std::string& properties) {
  const RawScene scene = triangle_with(properties);
  EXPECT_EQ(scene.materials.size(), 1u);
  return scene.materials.empty() ? Material() : scene.materials[0];
}

TEST(FbxMaterial, BaseColourIsDiffuseTimesItsFactor) {
  const Material m = paint(color("DiffuseColor", "0.5,0.25,1") + number("DiffuseFactor", "0.5"));
  EXPECT_EQ(m.name, "paint");
  EXPECT_LT((m.base_color - Vec4(0.25, 0.125, 0.5, 1)).norm(), kFloat);
  EXPECT_EQ(m.metallic, 0);
  EXPECT_EQ(m.alpha_mode, AlphaMode::Opaque);
}

TEST(FbxMaterial, EmissionIsColourTimesItsFactor) {
  const std::string red = color("EmissiveColor", "1,0,0");
  EXPECT_TRUE(paint(red + number("EmissiveFactor", "0")).emissive.isZero(0));
  EXPECT_LT((paint(red + number("EmissiveFactor", "0.5")).emissive - Vec3(0.5, 0, 0)).norm(), kFloat);
}

// An exponent of 0 is matt, one of 100 smooth; between them roughness is 1 - sqrt(exponent / 100), as in
// Blender.
TEST(FbxMaterial, RoughnessFollowsShininess) {
  EXPECT_NEAR(paint(number("ShininessExponent", "0")).roughness, 1, kFloat);
  EXPECT_NEAR(paint(number("ShininessExponent", "25")).roughness, 0.5, kFloat);
  EXPECT_NEAR(paint(number("ShininessExponent", "400")).roughness, 0, kFloat);
}

// What shines through is colour times factor.
TEST(FbxMaterial, Opacity) {
  const std::string white = color("TransparentColor", "1,1,1"), black = color("TransparentColor", "0,0,0");
  EXPECT_NEAR(paint(white + number("TransparencyFactor", "0.25")).base_color.w(), 0.75, kFloat);
  EXPECT_EQ(paint(white + number("TransparencyFactor", "0.25")).alpha_mode, AlphaMode::Blend);
  EXPECT_EQ(paint(white + number("TransparencyFactor", "0")).base_color.w(), 1);
  EXPECT_EQ(paint(black + number("TransparencyFactor", "1")).base_color.w(), 1);
}

std::set<std::string> codes(const RawScene& scene) {
  std::set<std::string> result;
  for (const Issue& issue : scene.issues) result.insert(issue.code);
  return result;
}

TEST(FbxMaterial, InvisibleOnesAreShown) {
  const RawScene scene =
      triangle_with(color("TransparentColor", "1,1,1") + number("TransparencyFactor", "1"));
  EXPECT_EQ(scene.materials.at(0).alpha_mode, AlphaMode::Opaque);
  EXPECT_TRUE(codes(scene).count("material-invisible"));
}

TEST(FbxMaterial, OneWithoutColourIsGreyAndSaysSo) {
  const RawScene scene = triangle_with("");
  EXPECT_LT((scene.materials.at(0).base_color - Vec4(kGrey, kGrey, kGrey, 1)).norm(), kFloat);
  EXPECT_TRUE(codes(scene).count("material-without-colour"));
  EXPECT_FALSE(codes(triangle_with(color("DiffuseColor", "0,0,0"))).count("material-without-colour"));
}

/// Materials by name.
std::map<std::string, Material> materials_of(const RawScene& scene) {
  std::map<std::string, Material> result;
  for (const Material& material : scene.materials) result.emplace(material.name, material);
  return result;
}

RawScene shared(const std::string& path) {
  return read_scene(read_input_files(testing::shared_file("assets/" + path)));
}

// The colours stand in the file, each with a DiffuseFactor of 0.8, a Shininess of 9.6078, an EmissiveFactor
// of 0 and a TransparentColor of 1 whose factor is 0.
TEST(FbxMaterial, TheDragonKeepsItsColours) {
  SKINFORGE_NEEDS_SHARED();
  const std::map<std::string, Vec3> wanted = {
      {"Main", {0.04970657, 0.01161225, 0.01444384}},  {"Wings", {0.01341041, 0.01341041, 0.01341041}},
      {"Belly", {0.32637572, 0.22614084, 0.02345699}}, {"Claws", {0.00901818, 0.00901818, 0.00901818}},
      {"Eyes", {0.01341041, 0.01341041, 0.01341041}},
  };
  const auto found = materials_of(shared("quaternius_dragon/dragon.fbx"));
  ASSERT_EQ(found.size(), wanted.size());
  for (const auto& [name, diffuse] : wanted) {
    const Material& m = found.at(name);
    EXPECT_LT((m.base_color.head<3>() - 0.8 * diffuse).norm(), kFloat) << name;
    EXPECT_NEAR(m.roughness, 1 - std::sqrt(0.096078431), kFloat) << name;
    EXPECT_EQ(m.alpha_mode, AlphaMode::Opaque) << name;
    EXPECT_TRUE(m.emissive.isZero(0)) << name;
  }
}

// These files have materials without any property, and no image: the people were coloured by a texture that
// their publisher did not put in.
TEST(FbxMaterial, ManWomanAndEagleHaveNoColourOfTheirOwn) {
  SKINFORGE_NEEDS_SHARED();
  for (const char* path :
       {"quaternius_man/man.fbx", "quaternius_woman/woman.fbx", "quaternius_eagle/eagle.fbx"}) {
    SCOPED_TRACE(path);
    const RawScene scene = shared(path);
    EXPECT_TRUE(codes(scene).count("material-without-colour"));
    for (const Material& m : scene.materials)
      EXPECT_LT((m.base_color - Vec4(kGrey, kGrey, kGrey, 1)).norm(), kFloat) << m.name;
  }
}

}  // namespace
}  // namespace skinforge
