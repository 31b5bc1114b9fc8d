#include "io/glb_polygons.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "base/expect.h"
#include "model/polygon_mesh.h"

namespace skinforge {
namespace {

constexpr double kThin = 1e-9;  // ours: part of a polygon's area below which a triangle is taken to have none

Vec3 area_normal(std::span<const Vec3> polygon) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    sum += (polygon[i] - polygon[0]).cross(polygon[i + 1] - polygon[0]);
  return sum;
}

/// Least area of a triangle of the fan from corner `start`, as part of the polygon's; negative when one is
/// turned over.
double least_area(std::span<const Vec3> polygon, const Vec3& normal, std::size_t start) {
  const std::size_t n = polygon.size();
  const Vec3& origin = polygon[start];
  double least = 1;
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const Vec3& b = polygon[(start + i) % n];
    const Vec3& c = polygon[(start + i + 1) % n];
    least = std::min(least, (b - origin).cross(c - origin).dot(normal) / normal.squaredNorm());
  }
  return least;
}

/// Corners to try first: of a quad those on the diagonal that `triangulate` takes.
std::vector<std::size_t> preferred_order(std::size_t count) {
  if (count == 4) return {0, 2, 1, 3};
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  return order;
}

/// Corners from which a fan covers the polygon: without a triangle of no area if possible, else without one
/// that is turned over. A polygon without area has nothing to turn over, and a quad is one fold at worst: any
/// corner will do.
std::vector<std::size_t> fan_starts(std::span<const Vec3> polygon) {
  const std::vector<std::size_t> all = preferred_order(polygon.size());
  const Vec3 normal = area_normal(polygon);
  if (polygon.size() == 3 || !(normal.squaredNorm() > 0)) return all;
  for (const double wanted : {kThin, -kThin}) {
    std::vector<std::size_t> starts = all;
    std::erase_if(starts, [&](std::size_t start) { return least_area(polygon, normal, start) < wanted; });
    if (!starts.empty()) return starts;
  }
  return polygon.size() == 4 ? all : std::vector<std::size_t>{};
}

}  // namespace

void FanWriter::add(std::span<const Vec3> positions, std::span<const std::uint32_t> vertices) {
  SF_EXPECT(positions.size() >= 3 && positions.size() == vertices.size());
  if (const auto start = first_free(fan_starts(positions), vertices)) return add_fan(vertices, *start);
  add_ears(positions, vertices);
}

/// The first of the starts that differs from the vertex at which the last polygon started.
std::optional<std::size_t> FanWriter::first_free(std::span<const std::size_t> starts,
                                                 std::span<const std::uint32_t> vertices) const {
  for (const std::size_t start : starts)
    if (!last_start_ || vertices[start] != *last_start_) return start;
  return std::nullopt;
}

void FanWriter::add_fan(std::span<const std::uint32_t> vertices, std::size_t start) {
  const std::size_t n = vertices.size();
  for (std::size_t i = 1; i + 1 < n; ++i)
    indices_.insert(indices_.end(),
                    {vertices[start], vertices[(start + i) % n], vertices[(start + i + 1) % n]});
  last_start_ = vertices[start];
}

void FanWriter::add_ears(std::span<const Vec3> positions, std::span<const std::uint32_t> vertices) {
  constexpr std::array<std::size_t, 3> kCorners = {0, 1, 2};
  ++broken_;
  for (const auto& ear : triangulate(positions)) {
    const std::array<std::uint32_t, 3> triangle = {vertices[static_cast<std::size_t>(ear[0])],
                                                   vertices[static_cast<std::size_t>(ear[1])],
                                                   vertices[static_cast<std::size_t>(ear[2])]};
    add_fan(triangle, first_free(kCorners, triangle).value_or(0));
  }
}

}  // namespace skinforge
