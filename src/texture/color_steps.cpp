#include "texture/color_steps.h"

#include <algorithm>
#include <cmath>

#include "geometry/edges.h"

namespace skinforge {
namespace {

// One face's side of an edge: its two corners, from the lower vertex to the higher.
struct EdgeSide {
  FaceId face;
  std::int32_t from = 0;
  std::int32_t to = 0;
};

EdgeSide side_of(const PolygonMesh& mesh, const EdgeList& edges, std::int32_t corner) {
  const std::int32_t next = edges.next_corner[corner];
  const FaceId face = edges.face_of_corner[corner];
  if (mesh.corners[corner] < mesh.corners[next]) return {face, corner, next};
  return {face, next, corner};
}

Vec3 encoded_color(const ColoredMesh& colored, const EdgeSide& side, double t) {
  const Vec3 linear = base_color_at(colored, side.face, {{side.from, side.to, side.to}, Vec3(1 - t, t, 0)});
  return {double(srgb8_from_linear(linear[0])), double(srgb8_from_linear(linear[1])),
          double(srgb8_from_linear(linear[2]))};
}

double step_between(const ColoredMesh& colored, const EdgeSide& a, const EdgeSide& b) {
  double sum = 0;
  for (const double t : {0.25, 0.5, 0.75})
    sum += (encoded_color(colored, a, t) - encoded_color(colored, b, t)).cwiseAbs().maxCoeff();
  return sum / 3;
}

}  // namespace

ColorSteps color_steps(const ColoredMesh& colored, std::span<const FaceId> new_faces) {
  const EdgeList edges = build_edges(*colored.mesh);
  std::vector<bool> is_new(colored.mesh->face_count(), false);
  for (const FaceId f : new_faces) is_new[f.index()] = true;
  std::vector<double> steps;
  for (const Edge& edge : edges.edges) {
    std::vector<EdgeSide> old_sides, new_sides;
    for (const std::int32_t corner : edge.half_edges) {
      const EdgeSide side = side_of(*colored.mesh, edges, corner);
      (is_new[side.face.index()] ? new_sides : old_sides).push_back(side);
    }
    if (!old_sides.empty() && !new_sides.empty())
      steps.push_back(step_between(colored, old_sides.front(), new_sides.front()));
  }
  ColorSteps result;
  if (steps.empty()) return result;
  std::sort(steps.begin(), steps.end());
  result.edges = steps.size();
  for (const double s : steps) result.mean += s / static_cast<double>(steps.size());
  result.p95 = steps[static_cast<std::size_t>(std::ceil(0.95 * static_cast<double>(steps.size()))) - 1];
  result.largest = steps.back();
  return result;
}

}  // namespace skinforge
