#include "render/texture_set.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "render/color.h"

namespace skinforge {
namespace {

using Vec2f = Eigen::Vector2f;
using Vec4f = Eigen::Vector4f;

int wrapped(int i, int size, Wrap wrap) {
  if (i >= 0 && i < size) return i;
  switch (wrap) {
    case Wrap::ClampToEdge:
      return std::clamp(i, 0, size - 1);
    case Wrap::MirroredRepeat: {
      const int period = 2 * size, k = ((i % period) + period) % period;
      return k < size ? k : period - 1 - k;
    }
    case Wrap::Repeat:
      break;
  }
  return ((i % size) + size) % size;
}

Vec4f texel(const Raster& image, int x, int y) {
  const auto* p = image.rgba.data() + 4 * (static_cast<std::size_t>(y) * image.width + x);
  return {linear_from_srgb(p[0]), linear_from_srgb(p[1]), linear_from_srgb(p[2]),
          static_cast<float>(p[3]) / 255};
}

void store(Raster& image, int x, int y, const Vec4f& color) {
  auto* p = image.rgba.data() + 4 * (static_cast<std::size_t>(y) * image.width + x);
  for (int k = 0; k < 3; ++k) p[k] = srgb_from_linear(color[k]);
  p[3] = static_cast<std::uint8_t>(std::lround(255 * color[3]));
}

Raster halved(const Raster& image) {
  Raster half{std::max(1, image.width / 2), std::max(1, image.height / 2), {}};
  half.rgba.resize(4 * static_cast<std::size_t>(half.width) * half.height);
  for (int y = 0; y < half.height; ++y)
    for (int x = 0; x < half.width; ++x) {
      const int x1 = std::min(2 * x + 1, image.width - 1), y1 = std::min(2 * y + 1, image.height - 1);
      const int x0 = std::min(2 * x, x1), y0 = std::min(2 * y, y1);
      store(half, x, y,
            0.25F *
                (texel(image, x0, y0) + texel(image, x1, y0) + texel(image, x0, y1) + texel(image, x1, y1)));
    }
  return half;
}

// KHR_texture_transform: scale, then rotation, then offset.
Vec2f transformed(const TextureRef& ref, const Vec2f& uv) {
  const Vec2f scaled = uv.cwiseProduct(ref.uv_scale.cast<float>());
  const Vec2f offset = ref.uv_offset.cast<float>();
  if (ref.uv_rotation == 0) return scaled + offset;
  const auto c = static_cast<float>(std::cos(ref.uv_rotation));
  const auto s = static_cast<float>(std::sin(ref.uv_rotation));
  return Vec2f(c * scaled.x() + s * scaled.y(), -s * scaled.x() + c * scaled.y()) + offset;
}

// Texel coordinates stay far inside int for any finite uv.
int floor_to_int(float value) {
  return static_cast<int>(std::clamp(std::floor(value), -1e8F, 1e8F));
}

Vec4f sample_level(const Raster& image, const TextureRef& ref, const Vec2f& uv) {
  const float x = uv.x() * static_cast<float>(image.width), y = uv.y() * static_cast<float>(image.height);
  if (ref.nearest)
    return texel(image, wrapped(floor_to_int(x), image.width, ref.wrap_u),
                 wrapped(floor_to_int(y), image.height, ref.wrap_v));
  const int x0 = floor_to_int(x - 0.5F), y0 = floor_to_int(y - 0.5F);
  const float fx = x - 0.5F - static_cast<float>(x0), fy = y - 0.5F - static_cast<float>(y0);
  const int left = wrapped(x0, image.width, ref.wrap_u), right = wrapped(x0 + 1, image.width, ref.wrap_u);
  const int top = wrapped(y0, image.height, ref.wrap_v), bottom = wrapped(y0 + 1, image.height, ref.wrap_v);
  return (1 - fy) * ((1 - fx) * texel(image, left, top) + fx * texel(image, right, top)) +
         fy * ((1 - fx) * texel(image, left, bottom) + fx * texel(image, right, bottom));
}

}  // namespace

TextureSet::TextureSet(std::span<const Raster> images) : levels_(images.size()) {
  parallel_for(images.size(), [&](std::size_t i) {
    if (images[i].width <= 0 || images[i].height <= 0) return;
    auto& chain = levels_[i];
    chain.push_back(images[i]);
    while (std::max(chain.back().width, chain.back().height) > 1) chain.push_back(halved(chain.back()));
  });
}

Vec4f TextureSet::sample(const TextureRef& ref, const Vec2f& uv, float spread) const {
  if (!ref.image.is_valid() || ref.image.index() >= levels_.size()) return Vec4f::Ones();
  const auto& chain = levels_[ref.image.index()];
  if (chain.empty()) return Vec4f::Ones();
  const Vec2f at = transformed(ref, uv);
  const auto scale = static_cast<float>(std::max(std::abs(ref.uv_scale.x()), std::abs(ref.uv_scale.y())));
  const float texels = spread * scale * static_cast<float>(std::max(chain[0].width, chain[0].height));
  const float level = ref.nearest || !(texels > 1) ? 0 : std::log2(texels);
  const std::size_t last = chain.size() - 1, fine = std::min(static_cast<std::size_t>(level), last);
  const float share = level - static_cast<float>(fine);
  const Vec4f color = sample_level(chain[fine], ref, at);
  if (fine == last || share <= 0) return color;
  return (1 - share) * color + share * sample_level(chain[fine + 1], ref, at);
}

}  // namespace skinforge
