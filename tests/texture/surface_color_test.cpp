#include "texture/surface_color.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace skinforge {
namespace {

constexpr double kRounding = 1e-12;  // a few products in double

// A 2 x 1 image: black and white texels side by side, green and alpha constant.
Raster black_white() {
  return {2, 1, {0, 51, 0, 255, 255, 51, 255, 255}};
}

double red(const TextureRef& texture, double u, double v = 0.5) {
  return sample(texture, black_white(), Vec2(u, v), Transfer::Linear)[0];
}

TEST(Srgb, KnownValuesAndRoundTrip) {
  EXPECT_EQ(linear_from_srgb8(0), 0);
  EXPECT_EQ(linear_from_srgb8(255), 1);
  EXPECT_NEAR(linear_from_srgb8(188), 0.5029, 1e-4);  // the standard's middle grey: 188 is half the light
  for (int i = 0; i < 256; ++i)
    EXPECT_EQ(srgb8_from_linear(linear_from_srgb8(static_cast<std::uint8_t>(i))), i);
  EXPECT_EQ(srgb8_from_linear(-1), 0);
  EXPECT_EQ(srgb8_from_linear(7), 255);
}

// Texel centres lie at u = 1/4 (black) and 3/4 (white); half way between them the light is one half.
TEST(Sample, BilinearBetweenTexelCentres) {
  TextureRef texture;
  EXPECT_NEAR(red(texture, 0.25), 0, kRounding);
  EXPECT_NEAR(red(texture, 0.5), 0.5, kRounding);
  EXPECT_NEAR(red(texture, 0.625), 0.75, kRounding);
  EXPECT_NEAR(sample(texture, black_white(), Vec2(0.3, 0.5), Transfer::Linear)[1], 0.2, kRounding);
}

TEST(Sample, FiltersInLinearLight) {
  EXPECT_NEAR(sample({}, black_white(), Vec2(0.5, 0.5), Transfer::Srgb)[0], 0.5, kRounding);
  EXPECT_NEAR(sample({}, black_white(), Vec2(0.5, 0.5), Transfer::Srgb)[1], linear_from_srgb8(51), kRounding);
}

// At u = 0 the left neighbour is: the white texel (repeat), the black one (clamp and mirror). At u = 1.25:
// black again (repeat), white (clamp), white (mirror: 1.25 is 0.75).
TEST(Sample, WrapModes) {
  TextureRef repeat, clamp, mirror;
  clamp.wrap_u = clamp.wrap_v = Wrap::ClampToEdge;
  mirror.wrap_u = mirror.wrap_v = Wrap::MirroredRepeat;
  EXPECT_NEAR(red(repeat, 0), 0.5, kRounding);
  EXPECT_NEAR(red(clamp, 0), 0, kRounding);
  EXPECT_NEAR(red(mirror, 0), 0, kRounding);
  EXPECT_NEAR(red(repeat, 1.25), 0, kRounding);
  EXPECT_NEAR(red(clamp, 1.25), 1, kRounding);
  EXPECT_NEAR(red(mirror, 1.25), 1, kRounding);
  EXPECT_NEAR(red(repeat, -0.25), 1, kRounding);
}

TEST(Sample, NearestTakesTheTexelItself) {
  TextureRef texture;
  texture.nearest = true;
  EXPECT_EQ(red(texture, 0.49), 0);
  EXPECT_EQ(red(texture, 0.51), 1);
}

// KHR_texture_transform: u' = offset + cos r * su * u + sin r * sv * v. Scale 1/2 and offset 1/4 send u = 1
// to 3/4; a quarter turn reads u' from v.
TEST(Sample, TextureTransform) {
  TextureRef scaled;
  scaled.uv_scale = Vec2(0.5, 1);
  scaled.uv_offset = Vec2(0.25, 0);
  EXPECT_NEAR(red(scaled, 1), 1, kRounding);
  EXPECT_NEAR(red(scaled, 0), 0, kRounding);
  TextureRef turned;
  turned.uv_rotation = radians(90);
  EXPECT_NEAR(red(turned, 0.1, 0.75), 1, kRounding);
  EXPECT_NEAR(red(turned, 0.1, 0.25), 0, kRounding);
}

TEST(Sample, OddInputIsWhiteOrFinite) {
  EXPECT_EQ(sample({}, Raster{}, Vec2(0, 0), Transfer::Srgb), Vec4::Ones());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(sample({}, black_white(), Vec2(nan, 1e300), Transfer::Srgb).allFinite());
}

// One triangle with vertex colours, a factor and a texture: by hand 0.5 * 0.5 * (texture) at the middle of
// corners 0 and 1.
TEST(BaseColor, FactorTimesTextureTimesVertexColour) {
  PolygonMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.corners = {VertexId(0), VertexId(1), VertexId(2)};
  mesh.face_begin = {0, 3};
  mesh.face_material = {MaterialId(0)};
  mesh.face_part = {PartId(0)};
  mesh.parts = {{"part", 1, false, true}};
  mesh.uvs = {{Vec2(0.25, 0.5), Vec2(0.75, 0.5), Vec2(0.25, 0.5)}};
  mesh.colors = {Vec4(1, 1, 1, 1), Vec4(0, 1, 1, 1), Vec4(1, 1, 1, 1)};
  std::vector<Material> materials(1);
  materials[0].base_color = Vec4(0.5, 1, 1, 1);
  materials[0].roughness = 0.5;
  materials[0].base_color_texture = TextureRef{};
  materials[0].base_color_texture->image = ImageId(0);
  materials[0].metallic_roughness_texture = materials[0].base_color_texture;
  const std::vector<Raster> images = {black_white()};
  const ColoredMesh colored{&mesh, materials, images};
  const CornerMix middle{{0, 1, 2}, Vec3(0.5, 0.5, 0)};
  EXPECT_NEAR(base_color_at(colored, FaceId(0), middle)[0], 0.5 * 0.5 * 0.5, kRounding);
  EXPECT_NEAR(look_at(colored, FaceId(0), middle).roughness, 0.5 * 0.2, kRounding);  // green is 51 / 255
  EXPECT_NEAR(look_at(colored, FaceId(0), middle).metallic, 1 * 0.5, kRounding);

  mesh.parts[0].has_colors = false;  // colours of a part that has none are not read
  EXPECT_NEAR(base_color_at(colored, FaceId(0), middle)[0], 0.5 * 0.5, kRounding);
  mesh.face_material[0] = MaterialId();
  EXPECT_EQ(base_color_at(colored, FaceId(0), middle), Vec3::Ones());
}

}  // namespace
}  // namespace skinforge
