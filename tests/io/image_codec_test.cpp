#include "io/image_codec.h"

#include <gmock/gmock.h>

#include "base/error.h"
#include "io/export.h"
#include "io/gltf_reader.h"
#include "testing/assets.h"
#include "testing/glb_file.h"

namespace skinforge {
namespace {

using ::testing::HasSubstr;

/// 3 x 2 pixels, all different.
Raster small_raster(std::uint8_t alpha) {
  Raster raster{3, 2, {}};
  for (int i = 0; i < 6; ++i)
    for (const int c : {10 * i, 200 - i, 7, int{alpha}}) raster.rgba.push_back(static_cast<std::uint8_t>(c));
  return raster;
}

std::string message(const Bytes& bytes) {
  try {
    inspect_image(bytes);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::BadInput);
    return error.what();
  }
  return "no error";
}

TEST(ImageCodec, PixelsComeBack) {
  for (const std::uint8_t alpha : {std::uint8_t{255}, std::uint8_t{128}}) {
    const Raster raster = small_raster(alpha);
    const Bytes png = encode_png(raster);
    EXPECT_EQ(png, encode_png(raster));
    const ImageHeader header = inspect_image(png);
    EXPECT_EQ(header.mime, "image/png");
    EXPECT_EQ(header.width, 3);
    EXPECT_EQ(header.height, 2);
    EXPECT_EQ(decode_image({"", "image/png", png}).rgba, raster.rgba);
    // Byte 25 is the colour type: 2 without alpha, 6 with.
    EXPECT_EQ(std::to_integer<int>(png[25]), alpha == 255 ? 2 : 6);
  }
}

TEST(ImageCodec, NoticesDamage) {
  const Bytes png = encode_png(small_raster(255));
  for (std::size_t size = 8; size < png.size(); ++size)
    EXPECT_EQ(message({png.begin(), png.begin() + static_cast<std::ptrdiff_t>(size)}), "truncated PNG");
  for (std::size_t i = 16; i < png.size(); i += 3) {
    Bytes flipped = png;
    flipped[i] ^= std::byte{1};
    EXPECT_NE(message(flipped), "no error") << i;
  }
  EXPECT_EQ(message({}), "image is neither PNG nor JPEG");
  EXPECT_EQ(message(testing::bytes_of("GIF89a")), "image is neither PNG nor JPEG");
  EXPECT_EQ(message(testing::bytes_of("\xFF\xD8\xFF\xE0")), "truncated JPEG");
}

TEST(ImageCodec, RefusesHugeImagesBeforeDecoding) {
  SKINFORGE_NEEDS_SHARED();
  const Bytes file = read_input_file(testing::shared_file("hostile/gen/image/png_bomb_40000.glb")).bytes;
  const std::string text(reinterpret_cast<const char*>(file.data()), file.size());
  const auto begin = text.find("\x89PNG");
  ASSERT_NE(begin, std::string::npos);
  EXPECT_THAT(message({file.begin() + static_cast<std::ptrdiff_t>(begin), file.end()}),
              HasSubstr("40000 x 40000 pixels, the limit is 16384; --limit image-side=N raises it"));
}

TEST(ImageCodec, DecodesTheImagesOfRealAssets) {
  SKINFORGE_NEEDS_SHARED();
  for (const char* asset :
       {"khronos_cesium_man/cesium_man.gltf", "khronos_fox/fox.glb", "kaykit_knight/knight.glb"}) {
    const RawScene scene = read_gltf(read_input_files(testing::shared_file("assets/" + std::string(asset))));
    ASSERT_EQ(scene.images.size(), 1u) << asset;
    const ImageHeader header = inspect_image(scene.images[0].bytes);
    const Raster raster = decode_image(scene.images[0]);
    EXPECT_EQ(raster.width, header.width);
    EXPECT_EQ(raster.height, header.height);
    EXPECT_EQ(header.mime, scene.images[0].mime);
  }
}

}  // namespace
}  // namespace skinforge
