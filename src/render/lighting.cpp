#include "render/lighting.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"

namespace skinforge {
namespace {

// All numbers below are ours, chosen by eye on spheres, tori and the test characters.
constexpr int kSkyAxes = 8;          // two directions each
constexpr int kSkyCoarser = 8;       // texels of the key light's map to one of a sky map: wide, soft edges
constexpr int kFloorTexels = 96;     // along the floor's map of the sky
constexpr float kFloorReach = 2.6F;  // half edge of that map, in radii of the character
constexpr float kFloorStrength = 0.80F;
constexpr float kFloorSkyShare = 0.55F;  // of the light on open floor
constexpr int kFloorBlur = 3;  // texels to each side: melts the few sky directions into one soft shadow
const Vec3f kSkyColor(0.64F, 0.69F, 0.76F), kGroundColor(0.40F, 0.38F, 0.37F);
const Vec3f kKeyColor(0.98F, 0.92F, 0.82F), kFillColor(0.10F, 0.11F, 0.14F), kRimColor(0.36F, 0.38F, 0.42F);
constexpr float kLeastCosine = 0.18F;  // flatter light is too weak for its shadows to matter
constexpr float kKeyWrap = 0.12F;      // light reaches a little past the terminator, as from a large lamp

Vec3f light_direction(double yaw, double pitch_deg) {
  return ViewAngles{yaw, radians(pitch_deg)}.direction().cast<float>();
}

// Axis i of a fan over the upper half sphere (golden-angle spiral, equal areas).
Vec3f sky_axis(int i) {
  const double y = (i + 0.5) / kSkyAxes, around = i * std::numbers::pi * (3 - std::sqrt(5.0));
  const double r = std::sqrt(1 - y * y);
  return Vec3(r * std::cos(around), y, r * std::sin(around)).cast<float>();
}

// Linear up to the knee, then bends towards 1, so that bright places keep their shape.
float soft_limit(float x) {
  constexpr float kKnee = 0.70F;
  if (x <= kKnee) return std::max(x, 0.0F);
  const float over = (x - kKnee) / (1 - kKnee);
  return kKnee + (1 - kKnee) * over / (1 + over);
}

float smooth_step(float low, float high, float x) {
  const float t = std::clamp((x - low) / (high - low), 0.0F, 1.0F);
  return t * t * (3 - 2 * t);
}

// Blinn-Phong lobe cosine^power; the power doubles from 4 (dull) to 128 (polished).
float highlight(float cosine, float gloss) {
  const int doublings = 2 + static_cast<int>(5 * gloss + 0.5F);
  for (int i = 0; i < doublings; ++i) cosine *= cosine;
  return cosine;
}

// Box filter of a square map along x, then along y; the border repeats.
void blur(std::vector<float>& map, int size, int reach) {
  std::vector<float> line(static_cast<std::size_t>(size));
  const auto blur_line = [&](std::size_t first, std::size_t stride) {
    const auto at = [&](int i) -> float& {
      return map[first + stride * static_cast<std::size_t>(std::clamp(i, 0, size - 1))];
    };
    float sum = 0;
    for (int i = -reach; i <= reach; ++i) sum += at(i);
    for (int i = 0; i < size; ++i) {
      line[static_cast<std::size_t>(i)] = sum / static_cast<float>(2 * reach + 1);
      sum += at(i + reach + 1) - at(i - reach);
    }
    for (int i = 0; i < size; ++i) at(i) = line[static_cast<std::size_t>(i)];
  };
  const auto edge = static_cast<std::size_t>(size);
  for (std::size_t i = 0; i < edge; ++i) blur_line(i * edge, 1);
  for (std::size_t i = 0; i < edge; ++i) blur_line(i, edge);
}

}  // namespace

Lighting::Lighting(std::span<const Vec3f> positions, std::span<const TriangleIndices> triangles,
                   const View& view, int detail, std::optional<double> floor)
    : key_direction_(light_direction(view.angles.yaw - radians(38), 50)),
      fill_direction_(light_direction(view.angles.yaw + radians(60), 12)),
      rim_direction_(light_direction(view.angles.yaw + radians(155), 32)) {
  Eigen::AlignedBox3f box;
  for (const TriangleIndices& t : triangles)
    for (const std::int32_t v : t) box.extend(positions[v]);
  center_ = box.isEmpty() ? Vec3f::Zero() : Vec3f(box.center());
  radius_ = box.isEmpty() ? 0 : 0.5F * box.diagonal().norm();
  if (!(radius_ > 0)) radius_ = 1;
  std::vector<std::optional<DepthMap>> maps(kSkyAxes + 1);
  parallel_for(maps.size(), [&](std::size_t i) {
    if (i == kSkyAxes)
      maps[i].emplace(positions, triangles, key_direction_, center_, 1.02F * radius_, detail);
    else
      maps[i].emplace(positions, triangles, sky_axis(static_cast<int>(i)), center_, 1.04F * radius_,
                      std::max(detail / kSkyCoarser, 32));
  });
  key_ = std::move(maps.back());
  for (int i = 0; i < kSkyAxes; ++i) sky_.push_back(std::move(*maps[static_cast<std::size_t>(i)]));
  if (floor) light_floor(static_cast<float>(*floor));
}

float Lighting::sky_light(const Vec3f& position, const Vec3f& normal) const {
  float seen = 0, all = 0;
  const Vec3f lifted = position + 1.2F * sky_[0].texel() * normal;
  for (const DepthMap& map : sky_) {
    const float cosine = normal.dot(map.direction());
    const float weight = std::abs(cosine);
    all += weight;
    seen += weight * (cosine > 0 ? map.light(lifted) : map.opposite_light(lifted));
  }
  return all > 0 ? seen / all : 1;
}

// The receiver is moved off its own surface: along the normal, and towards the lamp as far as a slanted
// surface rises under the filter's box.
float Lighting::key_light(const Vec3f& position, const Vec3f& normal) const {
  const float cosine = normal.dot(key_direction_);
  if (cosine <= -kKeyWrap) return 0;
  const float slope = std::sqrt(std::max(0.0F, 1 - cosine * cosine)) / std::max(cosine, kLeastCosine);
  return key_->light(position + key_->texel() * (1.5F * normal + 2 * slope * key_direction_));
}

Vec3f Lighting::shade(const SurfacePoint& point, const Finish& finish, float sky) const {
  const Vec3f& n = point.normal;
  const float lamp = key_light(point.position, n);
  const float key = lamp * std::max(0.0F, (n.dot(key_direction_) + kKeyWrap) / (1 + kKeyWrap));
  const float fill = std::max(0.0F, n.dot(fill_direction_));
  const float up = 0.5F + 0.5F * n.y();
  const Vec3f ambient = (0.25F + 0.75F * sky) * sky * (up * kSkyColor + (1 - up) * kGroundColor);
  const Vec3f light = ambient + key * kKeyColor + (0.3F + 0.7F * sky) * fill * kFillColor;

  const float facing = std::clamp(n.dot(point.to_eye), 0.0F, 1.0F);
  const float edge = (1 - facing) * (1 - facing) * (1 - facing);
  const Vec3f half = (key_direction_ + point.to_eye).normalized();
  const float gloss = 1 - finish.roughness;
  const float glint = lamp * highlight(std::max(0.0F, n.dot(half)), gloss) * (0.25F + 2 * gloss);
  const Vec3f reflectance = Vec3f::Constant(0.04F * (1 - finish.metallic)) + finish.metallic * finish.albedo;
  const float mirror_up = 0.5F + 0.5F * (2 * n.dot(point.to_eye) * n.y() - point.to_eye.y());
  const Vec3f mirrored = sky * (mirror_up * kSkyColor + (1 - mirror_up) * kGroundColor);

  const float rim = edge * std::max(0.0F, n.dot(rim_direction_) + 0.25F) * sky;
  const Vec3f color = (1 - 0.75F * finish.metallic) * finish.albedo.cwiseProduct(light) +
                      reflectance.cwiseProduct(glint * kKeyColor + (0.4F + 0.6F * gloss) * mirrored) +
                      rim * (0.35F * kRimColor + 0.65F * kRimColor.cwiseProduct(finish.albedo)) +
                      finish.emissive;
  return color.unaryExpr(&soft_limit);
}

void Lighting::light_floor(float height) {
  floor_ = height;
  const float step = 2 * kFloorReach * radius_ / (kFloorTexels - 1);
  const auto point = [&](std::size_t i) {
    const Vec3f corner(center_.x() - kFloorReach * radius_, height, center_.z() - kFloorReach * radius_);
    return Vec3f(corner +
                 step * Vec3f(static_cast<float>(i % kFloorTexels), 0, static_cast<float>(i / kFloorTexels)));
  };
  floor_map_.resize(static_cast<std::size_t>(kFloorTexels) * kFloorTexels);
  parallel_chunks(floor_map_.size(), kFloorTexels, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) floor_map_[i] = sky_light(point(i), Vec3f::UnitY());
  });
  for (int pass = 0; pass < 2; ++pass) blur(floor_map_, kFloorTexels, kFloorBlur);
}

// Share of the light on open floor that is left at `p`, where `sky` of the sky is seen.
float Lighting::floor_share(const Vec3f& p, float sky) const {
  const float open = std::max(0.0F, key_direction_.y());
  const float key = key_->light(p + 1.5F * key_->texel() * Vec3f::UnitY());
  return (kFloorSkyShare * sky * sky + (1 - kFloorSkyShare) * open * key) /
         (kFloorSkyShare + (1 - kFloorSkyShare) * open);
}

float Lighting::floor_light(const Vec3f& eye, const Vec3f& ray) const {
  if (!floor_ || !(ray.y() < 0) || *floor_ >= eye.y()) return 1;
  const Vec3f p = eye + (*floor_ - eye.y()) / ray.y() * ray;
  const float east = (p.x() - center_.x()) / radius_, south = (p.z() - center_.z()) / radius_;
  const float away = east * east + south * south;
  if (!(away < kFloorReach * kFloorReach)) return 1;
  const float x = (east / kFloorReach + 1) * 0.5F * (kFloorTexels - 1);
  const float z = (south / kFloorReach + 1) * 0.5F * (kFloorTexels - 1);
  const int i = std::min(static_cast<int>(x), kFloorTexels - 2),
            j = std::min(static_cast<int>(z), kFloorTexels - 2);
  const float fx = x - static_cast<float>(i), fz = z - static_cast<float>(j);
  const float* at = floor_map_.data() + static_cast<std::size_t>(j) * kFloorTexels + i;
  const float sky = (1 - fz) * ((1 - fx) * at[0] + fx * at[1]) +
                    fz * ((1 - fx) * at[kFloorTexels] + fx * at[kFloorTexels + 1]);
  const float shade = kFloorStrength * (1 - floor_share(p, sky));
  return 1 - shade * (1 - smooth_step(1.1F, kFloorReach, std::sqrt(away)));
}

}  // namespace skinforge
