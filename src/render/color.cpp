#include "render/color.h"

#include <algorithm>
#include <cmath>

namespace skinforge {
namespace {

constexpr double kGoldenSection = 0.61803398874989484;  // of a turn: the most irregular step there is
constexpr int kEncodeSteps = 8192;                      // ours: under half a code of error at the dark end

double decode(double srgb) {
  return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
}

double encode(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

// Ottosson 2020, "A perceptual color space for image processing": OKLab to linear sRGB.
Vec3 linear_from_oklab(double l, double a, double b) {
  const double long_root = l + 0.3963377774 * a + 0.2158037573 * b;
  const double medium_root = l - 0.1055613458 * a - 0.0638541728 * b;
  const double short_root = l - 0.0894841775 * a - 1.2914855480 * b;
  const double x = std::pow(long_root, 3), y = std::pow(medium_root, 3), z = std::pow(short_root, 3);
  return {4.0767416621 * x - 3.3077115913 * y + 0.2309699292 * z,
          -1.2684380046 * x + 2.6097574011 * y - 0.3413193965 * z,
          -0.0041960863 * x - 0.7034186147 * y + 1.7076147010 * z};
}

std::array<float, 256> make_decode_table() {
  std::array<float, 256> values{};
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = static_cast<float>(decode(static_cast<double>(i) / 255));
  return values;
}

std::array<std::uint8_t, kEncodeSteps + 1> make_encode_table() {
  std::array<std::uint8_t, kEncodeSteps + 1> codes{};
  for (std::size_t i = 0; i < codes.size(); ++i)
    codes[i] = static_cast<std::uint8_t>(std::lround(255 * encode(static_cast<double>(i) / kEncodeSteps)));
  return codes;
}

const std::array<float, 256> kDecoded = make_decode_table();
const std::array<std::uint8_t, kEncodeSteps + 1> kEncoded = make_encode_table();

}  // namespace

float linear_from_srgb(std::uint8_t code) {
  return kDecoded[code];
}

std::uint8_t srgb_from_linear(float value) {
  const float cut = value > 0 ? std::min(value, 1.0F) : 0.0F;  // NaN becomes 0
  return kEncoded[static_cast<std::size_t>(cut * kEncodeSteps + 0.5F)];
}

Vec3 rgb_color(int red, int green, int blue) {
  return {decode(red / 255.0), decode(green / 255.0), decode(blue / 255.0)};
}

Vec3 oklch_color(double lightness, double chroma, double hue) {
  const double angle = 2 * std::numbers::pi * hue;
  constexpr int kChromaSteps = 32;  // ours: steps of 3 %, below what the eye tells apart
  for (int i = kChromaSteps; i > 0; --i) {
    const double c = chroma * i / kChromaSteps;
    const Vec3 color = linear_from_oklab(lightness, c * std::cos(angle), c * std::sin(angle));
    if (color.minCoeff() >= 0 && color.maxCoeff() <= 1) return color;
  }
  return linear_from_oklab(lightness, 0, 0).cwiseMax(0.0).cwiseMin(1.0);
}

std::vector<Vec3> joint_colors(std::size_t count) {
  std::vector<Vec3> colors;
  for (std::size_t i = 0; i < count; ++i) {
    const double hue = std::fmod(0.07 + static_cast<double>(i) * kGoldenSection, 1.0);
    colors.push_back(i % 2 == 0 ? oklch_color(0.74, 0.15, hue) : oklch_color(0.58, 0.16, hue));
  }
  return colors;
}

std::vector<Vec3> dominant_weight_colors(const SkinWeights& weights, std::size_t joint_count) {
  const std::vector<Vec3> palette = joint_colors(joint_count);
  std::vector<Vec3> colors(weights.vertex_count(), rgb_color(0x80, 0x80, 0x80));
  for (std::size_t v = 0; v < colors.size(); ++v) {
    const auto row = weights.of(VertexId(v));
    const auto strongest = std::max_element(
        row.begin(), row.end(), [](const Influence& a, const Influence& b) { return a.weight < b.weight; });
    if (strongest != row.end()) colors[v] = palette[strongest->joint.index()];
  }
  return colors;
}

Vec3 heat_color(double value) {
  const double t = std::clamp(value, 0.0, 1.0);
  return oklch_color(0.93 - 0.53 * t, std::min(0.17, 0.6 * t), 0.27 - 0.20 * t);
}

std::vector<Vec3> joint_weight_colors(const SkinWeights& weights, JointId joint) {
  std::vector<Vec3> colors(weights.vertex_count(), heat_color(0));
  for (std::size_t v = 0; v < colors.size(); ++v)
    for (const Influence& influence : weights.of(VertexId(v)))
      if (influence.joint == joint) colors[v] = heat_color(influence.weight);
  return colors;
}

}  // namespace skinforge
