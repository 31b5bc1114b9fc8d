#include <gmock/gmock.h>

#include "io/export.h"
#include "io/image_codec.h"
#include "io/png_chunks.h"

namespace skinforge {
namespace {
using ::testing::ElementsAre;

Raster plain(std::uint8_t shade) {
  Raster raster{3, 2, std::vector<std::uint8_t>(24, shade)};
  for (std::size_t i = 3; i < 24; i += 4) raster.rgba[i] = 255;
  return raster;
}

std::uint32_t number_at(std::span<const std::byte> data, std::size_t at, int size) {
  std::uint32_t number = 0;
  for (int i = 0; i < size; ++i)
    number = number << 8 | std::to_integer<std::uint32_t>(data[at + static_cast<std::size_t>(i)]);
  return number;
}

// The chunks in the order of the specification; sequence numbers count fcTL and fdAT together; 40 ms a frame.
TEST(AnimatedPng, HasTheChunksOfTheSpecification) {
  const Bytes png = encode_animated_png(std::vector<Raster>{plain(10), plain(200), plain(90)}, 0.04);
  std::vector<std::string> kinds;
  std::vector<std::uint32_t> sequence;
  for (const PngChunk& chunk : png_chunks(png)) {
    kinds.push_back(chunk.kind);
    if (chunk.kind == "fcTL" || chunk.kind == "fdAT") sequence.push_back(number_at(chunk.data, 0, 4));
    if (chunk.kind == "acTL") {
      EXPECT_EQ(number_at(chunk.data, 0, 4), 3U);
    }
    if (chunk.kind == "fcTL") {
      EXPECT_EQ(chunk.data.size(), 26U);
      EXPECT_EQ(number_at(chunk.data, 20, 2), 40U);
      EXPECT_EQ(number_at(chunk.data, 22, 2), 1000U);
    }
  }
  EXPECT_THAT(kinds, ElementsAre("IHDR", "acTL", "fcTL", "IDAT", "fcTL", "fdAT", "fcTL", "fdAT", "IEND"));
  EXPECT_THAT(sequence, ElementsAre(0, 1, 2, 3, 4));
}

// Readers of plain PNG see the first frame; all checksums are right.
TEST(AnimatedPng, IsAPngOfItsFirstFrame) {
  const Bytes png = encode_animated_png(std::vector<Raster>{plain(10), plain(200)}, 0.04);
  EXPECT_EQ(inspect_image(png).width, 3);
  EXPECT_EQ(decode_image({"frame", "image/png", png}).rgba, plain(10).rgba);
}

}  // namespace
}  // namespace skinforge
