#include "render/texture_set.h"

#include <gmock/gmock.h>

#include "render/color.h"

namespace skinforge {
namespace {

using Vec2f = Eigen::Vector2f;
constexpr float kFloat = 1e-6F;  // a few roundings to float

// Grey levels of a picture 2 wide and 1 high: black, white.
TextureSet black_white() {
  const Raster image{2, 1, {0, 0, 0, 255, 255, 255, 255, 255}};
  return TextureSet(std::span(&image, 1));
}

float red(const TextureSet& set, const TextureRef& ref, float u, float spread = 0) {
  return set.sample(ref, Vec2f(u, 0.5F), spread).x();
}

// Texel centres are at 0.25 and 0.75; halfway between them the linear mean, at the border the wrap decides.
TEST(TextureSet, BilinearByHand) {
  const TextureSet set = black_white();
  const TextureRef repeat{.image = ImageId(0)};
  EXPECT_NEAR(red(set, repeat, 0.25F), 0, kFloat);
  EXPECT_NEAR(red(set, repeat, 0.75F), 1, kFloat);
  EXPECT_NEAR(red(set, repeat, 0.5F), 0.5, kFloat);
  EXPECT_NEAR(red(set, repeat, 0.375F), 0.25, kFloat);
  EXPECT_NEAR(red(set, repeat, 0.0F), 0.5, kFloat);
}

TEST(TextureSet, WrapModesByHand) {
  const TextureSet set = black_white();
  const TextureRef repeat{.image = ImageId(0), .wrap_u = Wrap::Repeat, .nearest = true};
  const TextureRef clamp{.image = ImageId(0), .wrap_u = Wrap::ClampToEdge, .nearest = true};
  const TextureRef mirror{.image = ImageId(0), .wrap_u = Wrap::MirroredRepeat, .nearest = true};
  EXPECT_EQ(red(set, repeat, 1.25F), 0);
  EXPECT_EQ(red(set, repeat, -0.25F), 1);
  EXPECT_EQ(red(set, clamp, 1.25F), 1);
  EXPECT_EQ(red(set, clamp, -0.25F), 0);
  EXPECT_EQ(red(set, mirror, 1.25F), 1);
  EXPECT_EQ(red(set, mirror, -0.25F), 0);
  EXPECT_EQ(red(set, mirror, 1.75F), 0);
}

// KHR_texture_transform: scale 0.5 and offset 0.5 send u = 0.5 to 0.75, the white texel.
TEST(TextureSet, TransformByHand) {
  const TextureRef ref{.image = ImageId(0), .uv_offset = Vec2(0.5, 0), .uv_scale = Vec2(0.5, 1)};
  EXPECT_NEAR(red(black_white(), ref, 0.5F), 1, kFloat);
}

TEST(TextureSet, FarAwayShowsTheLinearMean) {
  const float mean = red(black_white(), {.image = ImageId(0)}, 0.75F, 1.0F);
  EXPECT_NEAR(mean, 0.5, 0.005);  // stored in 8 bits: half a code of sRGB 188
}

TEST(TextureSet, MissingImagesAreWhite) {
  EXPECT_EQ(red(black_white(), {.image = ImageId(3)}, 0.2F), 1);
  EXPECT_EQ(red(black_white(), {}, 0.2F), 1);
  const Raster empty;
  EXPECT_EQ(red(TextureSet(std::span(&empty, 1)), {.image = ImageId(0)}, 0.2F), 1);
}

}  // namespace
}  // namespace skinforge
