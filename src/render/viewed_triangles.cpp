#include "render/viewed_triangles.h"

#include <algorithm>
#include <cmath>

namespace skinforge {
namespace {

constexpr double kWireFadeLow = 1.5, kWireFadeHigh = 6;  // ours: pixels of triangle height, chosen by eye

double smooth_step(double low, double high, double x) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

Vec2 on_picture(const Vec3& corner) {
  return {corner.x() / corner.z(), corner.y() / corner.z()};
}

double twice_area(const Vec2& a, const Vec2& b, const Vec2& c) {
  return std::abs((b - a).x() * (c - a).y() - (b - a).y() * (c - a).x());
}

// Square root of the ratio of areas: the mean over both directions of uv per pixel.
float uv_spread(const Subject& subject, std::size_t triangle, const std::array<Vec3, 3>& corners) {
  const auto& texture = subject.material_of(subject.face_of(triangle)).base_color_texture;
  if (!texture || static_cast<std::size_t>(texture->uv_set) >= subject.mesh().uvs.size()) return 0;
  const auto& uvs = subject.mesh().uvs[static_cast<std::size_t>(texture->uv_set)];
  const auto& c = subject.triangle_corners()[triangle];
  const double pixels = twice_area(on_picture(corners[0]), on_picture(corners[1]), on_picture(corners[2]));
  if (!(pixels > 0)) return 0;
  return static_cast<float>(std::sqrt(twice_area(uvs[c[0]], uvs[c[1]], uvs[c[2]]) / pixels));
}

std::array<float, 3> wire_strengths(const Subject& subject, std::size_t triangle,
                                    const ScreenTriangle& screen, const std::array<Vec3, 3>& corners) {
  std::array<float, 3> strengths = {0, 0, 0};
  for (int i = 0; i < 3; ++i) {
    if (!subject.is_polygon_edge(triangle, i)) continue;
    const Vec2 top = on_picture(corners[static_cast<std::size_t>(i)]);
    const double height = screen.edge_distance(i, top.x(), top.y());
    strengths[static_cast<std::size_t>(i)] =
        static_cast<float>(smooth_step(kWireFadeLow, kWireFadeHigh, height));
  }
  return strengths;
}

}  // namespace

std::vector<ViewedTriangle> viewed_triangles(const Subject& subject, std::span<const Vec3> positions,
                                             const Projection& projection, const ViewedOptions& options) {
  std::vector<Vec3> points(positions.size());
  std::transform(positions.begin(), positions.end(), points.begin(), projection);
  std::vector<ViewedTriangle> viewed;
  for (std::size_t i = 0; i < subject.triangles().size(); ++i) {
    const auto& [a, b, c] = subject.triangles()[i];
    const std::array<Vec3, 3> corners{points[a], points[b], points[c]};
    const auto screen = screen_triangle(corners, projection);
    if (!screen) continue;
    if (!screen->is_front && !options.back_faces && !subject.material_of(subject.face_of(i)).double_sided)
      continue;
    ViewedTriangle& triangle = viewed.emplace_back();
    triangle.screen = *screen;
    triangle.triangle = static_cast<std::int32_t>(i);
    triangle.spread = uv_spread(subject, i, corners);
    if (options.wireframe) triangle.wire = wire_strengths(subject, i, *screen, corners);
  }
  return viewed;
}

std::vector<std::vector<std::int32_t>> triangles_by_tile(std::span<const ViewedTriangle> triangles,
                                                         int tiles_across, int tiles_down) {
  std::vector<std::vector<std::int32_t>> tiles(static_cast<std::size_t>(tiles_across) * tiles_down);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const auto& [x0, y0, x1, y1] = triangles[i].screen.box;
    for (int y = y0 / VisibilityTile::kEdge; y <= y1 / VisibilityTile::kEdge; ++y)
      for (int x = x0 / VisibilityTile::kEdge; x <= x1 / VisibilityTile::kEdge; ++x)
        tiles[static_cast<std::size_t>(y) * tiles_across + x].push_back(static_cast<std::int32_t>(i));
  }
  return tiles;
}

}  // namespace skinforge
