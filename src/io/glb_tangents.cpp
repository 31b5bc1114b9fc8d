#include "io/glb_tangents.h"

#include <algorithm>
#include <cmath>

namespace skinforge {
namespace {

Vec3 vec3(const std::vector<float>& numbers, std::uint32_t vertex) {
  return {numbers[3 * vertex], numbers[3 * vertex + 1], numbers[3 * vertex + 2]};
}
Vec2 vec2(const std::vector<float>& numbers, std::uint32_t vertex) {
  return {numbers[2 * vertex], numbers[2 * vertex + 1]};
}

/// Direction in which u grows on the two edges a and b with UV steps `uv_a` and `uv_b`; zero when those are
/// parallel.
Vec3 u_direction(const Vec3& a, const Vec3& b, const Vec2& uv_a, const Vec2& uv_b) {
  const double area = uv_a.x() * uv_b.y() - uv_a.y() * uv_b.x();
  return ((uv_b.y() * a - uv_a.y() * b) * (area < 0 ? -1 : 1)).stableNormalized() * (area == 0 ? 0 : 1);
}

double angle(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

Vec3 flattened(const Vec3& direction, const Vec3& normal) {
  return (direction - normal * normal.dot(direction)).stableNormalized();
}

Vec3 any_orthogonal(const Vec3& normal) {
  Vec3::Index axis = 0;
  normal.cwiseAbs().minCoeff(&axis);
  return flattened(Vec3::Unit(axis), normal);
}

}  // namespace

float uv_handedness(std::span<const Vec2> uvs) {
  double area = 0;  // twice, with v down
  for (std::size_t i = 1; i + 1 < uvs.size(); ++i) {
    const Vec2 a = uvs[i] - uvs[0], b = uvs[i + 1] - uvs[0];
    area += a.x() * b.y() - a.y() * b.x();
  }
  return area > 0 ? -1.0F : 1.0F;
}

std::vector<float> vertex_tangents(const TangentInput& input) {
  std::vector<Vec3> sums(input.positions.size() / 3, Vec3::Zero());
  for (const auto& polygon : input.polygons)
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const std::uint32_t here = polygon[i], after = polygon[(i + 1) % polygon.size()],
                          before = polygon[(i + polygon.size() - 1) % polygon.size()];
      const Vec3 a = vec3(input.positions, after) - vec3(input.positions, here);
      const Vec3 b = vec3(input.positions, before) - vec3(input.positions, here);
      const Vec2 uv = vec2(input.uvs, here);
      const Vec3 direction = u_direction(a, b, vec2(input.uvs, after) - uv, vec2(input.uvs, before) - uv);
      sums[here] += angle(a, b) * flattened(direction, vec3(input.normals, here));
    }
  std::vector<float> tangents;
  for (std::uint32_t v = 0; v < sums.size(); ++v) {
    const Vec3 normal = vec3(input.normals, v);
    Vec3 tangent = flattened(sums[v], normal);
    if (!(tangent.squaredNorm() > 0.5)) tangent = any_orthogonal(normal);  // unit length or nothing
    for (const double x : tangent) tangents.push_back(static_cast<float>(x));
    tangents.push_back(input.handedness[v]);
  }
  return tangents;
}

}  // namespace skinforge
