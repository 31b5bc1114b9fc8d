#include "texture/texel_map.h"

#include <algorithm>
#include <cmath>

#include "base/expect.h"

namespace skinforge {
namespace {

using Triangle2 = std::array<Vec2, 3>;

double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// Barycentric coordinates of the point of segment i, i + 1 that is nearest to p.
Vec3 nearest_on_edge(const Triangle2& t, int i, const Vec2& p) {
  const int j = (i + 1) % 3;
  const Vec2 edge = t[j] - t[i];
  const double length2 = edge.squaredNorm();
  const double s = length2 > 0 ? std::clamp((p - t[i]).dot(edge) / length2, 0.0, 1.0) : 0.0;
  Vec3 barycentric = Vec3::Zero();
  barycentric[i] = 1 - s;
  barycentric[j] = s;
  return barycentric;
}

Vec2 point_at(const Triangle2& t, const Vec3& barycentric) {
  return t[0] * barycentric[0] + t[1] * barycentric[1] + t[2] * barycentric[2];
}

// Barycentric coordinates of the point of the triangle that is nearest to p.
Vec3 nearest_in_triangle(const Triangle2& t, const Vec2& p) {
  const double area = cross(t[1] - t[0], t[2] - t[0]);
  if (area != 0) {
    const double b1 = cross(p - t[0], t[2] - t[0]) / area, b2 = cross(t[1] - t[0], p - t[0]) / area;
    const Vec3 inside(1 - b1 - b2, b1, b2);
    if (inside.minCoeff() >= 0) return inside;
  }
  Vec3 best = nearest_on_edge(t, 0, p);
  for (int i = 1; i < 3; ++i) {
    const Vec3 other = nearest_on_edge(t, i, p);
    if ((point_at(t, other) - p).squaredNorm() < (point_at(t, best) - p).squaredNorm()) best = other;
  }
  return best;
}

// First and last texel whose centre lies within `reach` of [low, high], cut to the image.
std::pair<int, int> texel_range(double low, double high, double reach, int size) {
  return {std::max(0, static_cast<int>(std::ceil(low - reach - 0.5))),
          std::min(size - 1, static_cast<int>(std::floor(high + reach - 0.5)))};
}

// One level of the pyramid: colour sums and how much of the square is known.
struct Level {
  int width = 0;
  int height = 0;
  std::vector<Vec4> color;
  std::vector<double> known;
};

Level base_level(const Raster& raster, const std::vector<bool>& is_set) {
  Level level{raster.width, raster.height, std::vector<Vec4>(is_set.size(), Vec4::Zero()),
              std::vector<double>(is_set.size(), 0)};
  for (std::size_t i = 0; i < is_set.size(); ++i) {
    if (!is_set[i]) continue;
    const std::uint8_t* p = &raster.rgba[4 * i];
    level.color[i] = Vec4(p[0], p[1], p[2], p[3]);
    level.known[i] = 1;
  }
  return level;
}

// The texel of the next level that texel `i` of `fine` is part of.
std::size_t coarser_texel(const Level& fine, const Level& coarse, std::size_t i) {
  const int x = static_cast<int>(i) % fine.width, y = static_cast<int>(i) / fine.width;
  return static_cast<std::size_t>(std::min(y / 2, coarse.height - 1)) * coarse.width +
         std::min(x / 2, coarse.width - 1);
}

Level half(const Level& fine) {
  Level level{std::max(1, fine.width / 2), std::max(1, fine.height / 2), {}, {}};
  const auto count = static_cast<std::size_t>(level.width) * level.height;
  level.color.assign(count, Vec4::Zero());
  level.known.assign(count, 0);
  for (std::size_t from = 0; from < fine.color.size(); ++from) {
    const std::size_t to = coarser_texel(fine, level, from);
    level.color[to] += fine.known[from] * fine.color[from];
    level.known[to] += fine.known[from];
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (!(level.known[i] > 0)) continue;
    level.color[i] /= level.known[i];
    level.known[i] = 1;
  }
  return level;
}

}  // namespace

std::vector<TexelPoint> map_texels(std::span<const std::array<Vec2, 3>> triangles, int width, int height,
                                   double reach) {
  const auto count = static_cast<std::size_t>(width) * height;
  std::vector<TexelPoint> map(count);
  std::vector<double> distance2(count, std::nextafter(reach * reach, 1e300));
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const Triangle2& t = triangles[i];
    const Vec2 low = t[0].cwiseMin(t[1]).cwiseMin(t[2]), high = t[0].cwiseMax(t[1]).cwiseMax(t[2]);
    const auto [left, right] = texel_range(low.x(), high.x(), reach, width);
    const auto [top, bottom] = texel_range(low.y(), high.y(), reach, height);
    for (int y = top; y <= bottom; ++y)
      for (int x = left; x <= right; ++x) {
        const auto at = static_cast<std::size_t>(y) * width + x;
        const Vec2 center(x + 0.5, y + 0.5);
        const Vec3 barycentric = nearest_in_triangle(t, center);
        const double d2 = (point_at(t, barycentric) - center).squaredNorm();
        if (d2 >= distance2[at]) continue;
        distance2[at] = d2;
        map[at] = {static_cast<std::int32_t>(i), barycentric};
      }
  }
  return map;
}

void fill_unset(Raster& raster, std::vector<bool> is_set) {
  SF_EXPECT((raster.width & (raster.width - 1)) == 0 && (raster.height & (raster.height - 1)) == 0);
  std::vector<Level> levels = {base_level(raster, is_set)};
  while (levels.back().color.size() > 1) levels.push_back(half(levels.back()));
  if (!(levels.back().known[0] > 0)) levels.back().color[0] = Vec4::Constant(255);
  for (std::size_t l = levels.size() - 1; l-- > 0;) {
    Level& fine = levels[l];
    const Level& coarse = levels[l + 1];
    for (std::size_t i = 0; i < fine.color.size(); ++i) {
      if (!(fine.known[i] > 0)) fine.color[i] = coarse.color[coarser_texel(fine, coarse, i)];
    }
  }
  for (std::size_t i = 0; i < is_set.size(); ++i) {
    if (is_set[i]) continue;
    for (int c = 0; c < 4; ++c)
      raster.rgba[4 * i + c] = static_cast<std::uint8_t>(std::lround(levels[0].color[i][c]));
  }
}

}  // namespace skinforge
