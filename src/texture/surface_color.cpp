#include "texture/surface_color.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace skinforge {
namespace {

std::array<double, 256> make_linear_table() {
  std::array<double, 256> table{};
  for (int i = 0; i < 256; ++i) {
    const double s = i / 255.0;
    table[i] = s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
  }
  return table;
}

// KHR_texture_transform: scale, then turn counter-clockwise as seen with v down, then shift.
Vec2 transformed(const TextureRef& texture, const Vec2& uv) {
  const Vec2 s = uv.cwiseProduct(texture.uv_scale);
  const double c = std::cos(texture.uv_rotation), n = std::sin(texture.uv_rotation);
  return Vec2(c * s.x() + n * s.y(), c * s.y() - n * s.x()) + texture.uv_offset;
}

int wrapped(long long i, int size, Wrap wrap) {
  const auto positive = [](long long a, long long b) { return ((a % b) + b) % b; };
  switch (wrap) {
    case Wrap::ClampToEdge:
      return static_cast<int>(std::clamp<long long>(i, 0, size - 1));
    case Wrap::MirroredRepeat: {
      const long long p = positive(i, 2LL * size);
      return static_cast<int>(p < size ? p : 2LL * size - 1 - p);
    }
    case Wrap::Repeat:
      break;
  }
  return static_cast<int>(positive(i, size));
}

Vec4 texel(const TextureRef& texture, const Raster& raster, long long x, long long y, Transfer transfer) {
  const auto column = static_cast<std::size_t>(wrapped(x, raster.width, texture.wrap_u));
  const auto row = static_cast<std::size_t>(wrapped(y, raster.height, texture.wrap_v));
  const std::uint8_t* p = &raster.rgba[4 * (row * static_cast<std::size_t>(raster.width) + column)];
  if (transfer == Transfer::Linear) return Vec4(p[0], p[1], p[2], p[3]) / 255.0;
  return {linear_from_srgb8(p[0]), linear_from_srgb8(p[1]), linear_from_srgb8(p[2]), p[3] / 255.0};
}

constexpr double kFarthestTexel = 1e15;  // ours: below it, neighbouring integers are still exact in double

// A coordinate in texels that is safe to turn into an integer.
double sound(double value) {
  return std::isfinite(value) ? std::clamp(value, -kFarthestTexel, kFarthestTexel) : 0;
}

template <class Value>
Value mixed(const std::vector<Value>& values, const CornerMix& at) {
  return values[at.corners[0]] * at.weights[0] + values[at.corners[1]] * at.weights[1] +
         values[at.corners[2]] * at.weights[2];
}

// The texture's value at a point; white where there is no texture, no image or no such UV set.
Vec4 texture_value(const ColoredMesh& colored, const std::optional<TextureRef>& texture, const CornerMix& at,
                   Transfer transfer) {
  if (!texture || !texture->image.is_valid() || texture->image.index() >= colored.images.size())
    return Vec4::Ones();
  const auto set = static_cast<std::size_t>(texture->uv_set);
  if (set >= colored.mesh->uvs.size()) return Vec4::Ones();
  return sample(*texture, colored.images[texture->image.index()], mixed(colored.mesh->uvs[set], at),
                transfer);
}

bool has_colors(const PolygonMesh& mesh, FaceId face) {
  const PartId part = mesh.face_part[face.index()];
  return !mesh.colors.empty() && part.is_valid() && mesh.parts[part.index()].has_colors;
}

}  // namespace

double linear_from_srgb8(std::uint8_t value) {
  static const std::array<double, 256> table = make_linear_table();
  return table[value];
}

std::uint8_t srgb8_from_linear(double value) {
  const double v = std::clamp(value, 0.0, 1.0);
  const double s = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(255 * s));
}

Vec4 sample(const TextureRef& texture, const Raster& raster, const Vec2& uv, Transfer transfer) {
  if (raster.width <= 0 || raster.height <= 0) return Vec4::Ones();
  const Vec2 moved = transformed(texture, uv);
  const double x = sound(moved.x() * raster.width), y = sound(moved.y() * raster.height);
  if (texture.nearest)
    return texel(texture, raster, std::llround(std::floor(x)), std::llround(std::floor(y)), transfer);
  const double left = std::floor(x - 0.5), top = std::floor(y - 0.5);
  const double fx = x - 0.5 - left, fy = y - 0.5 - top;
  const auto i = static_cast<long long>(left), j = static_cast<long long>(top);
  return (1 - fy) * ((1 - fx) * texel(texture, raster, i, j, transfer) +
                     fx * texel(texture, raster, i + 1, j, transfer)) +
         fy * ((1 - fx) * texel(texture, raster, i, j + 1, transfer) +
               fx * texel(texture, raster, i + 1, j + 1, transfer));
}

const Material& material_of(const ColoredMesh& colored, FaceId face) {
  static const Material plain;
  const MaterialId id = colored.mesh->face_material[face.index()];
  return id.is_valid() ? colored.materials[id.index()] : plain;
}

Vec3 base_color_at(const ColoredMesh& colored, FaceId face, const CornerMix& at) {
  const Material& material = material_of(colored, face);
  Vec4 color = material.base_color.cwiseProduct(
      texture_value(colored, material.base_color_texture, at, Transfer::Srgb));
  if (has_colors(*colored.mesh, face)) color = color.cwiseProduct(mixed(colored.mesh->colors, at)).eval();
  return color.head<3>();
}

SurfaceLook look_at(const ColoredMesh& colored, FaceId face, const CornerMix& at) {
  const Material& material = material_of(colored, face);
  const Vec4 rough = texture_value(colored, material.metallic_roughness_texture, at, Transfer::Linear);
  const Vec4 glow = texture_value(colored, material.emissive_texture, at, Transfer::Srgb);
  SurfaceLook look;
  look.base_color = base_color_at(colored, face, at);
  look.emissive = material.emissive.cwiseProduct(glow.head<3>());
  look.roughness = material.roughness * rough[1];  // glTF: green is roughness, blue is metallic
  look.metallic = material.metallic * rough[2];
  return look;
}

}  // namespace skinforge
