#include "diff/surface_diff.h"

#include <algorithm>
#include <numeric>

#include "base/parallel.h"
#include "geometry/triangle_bvh.h"

namespace skinforge {

namespace {
struct Surface {
  std::vector<std::array<std::int32_t, 3>> triangles;
  double area = 0;

  explicit Surface(const PolygonMesh& mesh) {
    for (const auto& t : triangulate(mesh).triangles) {
      triangles.push_back({t[0].value, t[1].value, t[2].value});
      const auto at = [&](int i) -> const Vec3& { return mesh.positions[t[i].index()]; };
      area += (at(1) - at(0)).cross(at(2) - at(0)).norm() / 2;
    }
  }
};

// Distance of each vertex of one mesh from the surface of another.
void add_distances(const PolygonMesh& from, const PolygonMesh& to, const Surface& surface,
                   std::vector<double>& distances) {
  if (surface.triangles.empty()) return;
  const TriangleBvh bvh(to.positions, surface.triangles);
  const std::size_t begin = distances.size();
  distances.resize(begin + from.vertex_count());
  constexpr std::size_t kChunk = 256;
  parallel_chunks(from.vertex_count(), kChunk, [&](std::size_t first, std::size_t last) {
    for (std::size_t v = first; v < last; ++v) distances[begin + v] = bvh.closest(from.positions[v]).distance;
  });
}
}  // namespace

std::string heaviest_joint(const Character& character, VertexId vertex) {
  const auto row = character.weights.of(vertex);
  return row.empty() ? std::string() : character.skeleton[row.front().joint].name;
}

GeometryDiff compare_surfaces(const Character& a, const Character& b, const Correspondence& same,
                              double diagonal) {
  GeometryDiff diff;
  const Surface of_a(a.mesh), of_b(b.mesh);
  diff.area_a = of_a.area;
  diff.area_b = of_b.area;
  std::vector<bool> is_met(b.mesh.vertex_count(), false);
  for (const VertexId image : same.vertices) {
    if (image.is_valid())
      is_met[image.index()] = true;
    else
      ++diff.unmatched_a;
  }
  // Several vertices of B at one place stand for one of A, so those that nobody meets are looked up back.
  const Correspondence back = correspond(b, a);
  for (std::size_t v = 0; v < is_met.size(); ++v)
    if (!is_met[v] && !back.vertices[v].is_valid()) ++diff.unmatched_b;

  std::vector<double> distances;
  add_distances(a.mesh, b.mesh, of_b, distances);
  add_distances(b.mesh, a.mesh, of_a, distances);
  if (distances.empty() || diagonal <= 0) return diff;
  std::sort(distances.begin(), distances.end());
  diff.max = distances.back() / diagonal;
  diff.p99 = distances[(distances.size() - 1) * 99 / 100] / diagonal;
  diff.mean = std::accumulate(distances.begin(), distances.end(), 0.0) / double(distances.size()) / diagonal;
  return diff;
}

SkinDiff compare_weights(const Character& a, const Character& b, const Correspondence& same) {
  constexpr double kStep = 1.0 / 255;
  SkinDiff diff;
  double sum = 0;
  std::size_t compared = 0;
  for (std::size_t v = 0; v < same.vertices.size(); ++v) {
    const VertexId image = same.vertices[v];
    if (!image.is_valid()) continue;
    const double distance = weight_distance(a.weights.of(VertexId(v)), b.weights.of(image), same.joints);
    sum += distance;
    ++compared;
    if (distance > kStep) ++diff.changed;
    if (distance <= diff.max) continue;
    diff.max = distance;
    diff.joint = heaviest_joint(a, VertexId(v));
  }
  diff.mean = compared > 0 ? sum / double(compared) : 0;
  return diff;
}

}  // namespace skinforge
