#include "io/inflate.h"

#include <limits>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wextra"
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#define STBI_NO_STDIO
#define STBI_NO_HDR
#define STBI_NO_LINEAR
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

namespace skinforge {

bool inflate_exactly(std::span<const std::byte> packed, std::span<std::byte> target) {
  constexpr auto kMost = static_cast<std::size_t>(std::numeric_limits<int>::max());
  if (packed.size() > kMost || target.size() > kMost) return false;
  const int size = static_cast<int>(target.size());
  return stbi_zlib_decode_buffer(reinterpret_cast<char*>(target.data()), size,
                                 reinterpret_cast<const char*>(packed.data()),
                                 static_cast<int>(packed.size())) == size;
}

}  // namespace skinforge
