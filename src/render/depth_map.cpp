#include "render/depth_map.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "render/four.h"

namespace skinforge {
namespace {

constexpr float kNothing = -std::numeric_limits<float>::infinity();
constexpr float kBias =
    1.0F;  // ours: texels; the receiver is moved off its surface as well (see lighting.cpp)

float cross2(const Vec3f& a, const Vec3f& b, float x, float y) {
  return (b.x() - a.x()) * (y - a.y()) - (b.y() - a.y()) * (x - a.x());
}

int first_center(float low) {
  return static_cast<int>(std::ceil(low - 0.5F));
}
int last_center(float high) {
  return static_cast<int>(std::floor(high - 0.5F));
}

}  // namespace

DepthMap::DepthMap(std::span<const Vec3f> positions, std::span<const TriangleIndices> triangles,
                   const Vec3f& direction, const Vec3f& center, float radius, int size)
    : size_(size),
      right_(direction.unitOrthogonal()),
      up_(direction.cross(right_)),
      back_(direction),
      center_(center),
      scale_(static_cast<float>(size) / (2 * radius)),
      nearest_(static_cast<std::size_t>(size) * size, kNothing),
      farthest_(nearest_) {
  std::vector<Vec3f> points(positions.size());
  std::transform(positions.begin(), positions.end(), points.begin(),
                 [&](const Vec3f& p) { return in_map(p); });
  for (const auto& [a, b, c] : triangles) draw(points[a], points[b], points[c]);
}

void DepthMap::draw(const Vec3f& a, const Vec3f& b, const Vec3f& c) {
  const int x0 = std::max(first_center(std::min({a.x(), b.x(), c.x()})), 0);
  const int x1 = std::min(last_center(std::max({a.x(), b.x(), c.x()})), size_ - 1);
  const int y0 = std::max(first_center(std::min({a.y(), b.y(), c.y()})), 0);
  const int y1 = std::min(last_center(std::max({a.y(), b.y(), c.y()})), size_ - 1);
  if (x0 > x1 || y0 > y1) return;
  const float area = cross2(a, b, c.x(), c.y());
  if (area == 0) return;
  const float per_area = 1 / area;
  for (int y = y0; y <= y1; ++y)
    for (int x = x0; x <= x1; ++x) {
      const float px = static_cast<float>(x) + 0.5F, py = static_cast<float>(y) + 0.5F;
      const float wa = cross2(b, c, px, py) * per_area, wb = cross2(c, a, px, py) * per_area;
      const float wc = cross2(a, b, px, py) * per_area;
      if (wa < 0 || wb < 0 || wc < 0) continue;
      const float height = wa * a.z() + wb * b.z() + wc * c.z();
      const std::size_t texel = static_cast<std::size_t>(y) * size_ + x;
      nearest_[texel] = std::max(nearest_[texel], height);
      farthest_[texel] = std::max(farthest_[texel], -height);
    }
}

// Percentage-closer filtering: a box 3 texels wide that slides with the point, so 4 x 4 texels with bilinear
// weights.
float DepthMap::filtered(const Vec3f& p, const std::vector<float>& depth, float sign) const {
  const Vec3f q = in_map(p);
  const float corner_x = q.x() - 1.5F, corner_y = q.y() - 1.5F;
  const auto limit = static_cast<float>(size_ - 4);
  if (!(corner_x >= 0 && corner_x < limit && corner_y >= 0 && corner_y < limit)) return 1;
  const int x0 = static_cast<int>(corner_x), y0 = static_cast<int>(corner_y);
  const float fx = corner_x - static_cast<float>(x0), fy = corner_y - static_cast<float>(y0);
  const float height = sign * q.z() + kBias;
  const float* texel = depth.data() + static_cast<std::size_t>(y0) * size_ + x0;
  const FourFloats nothing = {0, 0, 0, 0}, one = {1, 1, 1, 1};
  const auto lit = [&](int row) { return load_four(texel + row * size_) <= height ? one : nothing; };
  const FourFloats columns = ((1 - fy) * lit(0) + lit(1)) + (lit(2) + fy * lit(3));
  return ((columns[0] * (1 - fx) + columns[1]) + (columns[2] + columns[3] * fx)) / 9;
}

}  // namespace skinforge
