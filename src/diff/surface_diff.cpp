#include "diff/surface_diff.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>

#include "base/parallel.h"
#include "geometry/triangle_bvh.h"

namespace skinforge {

namespace {
struct Surface {
  std::vector<std::array<std::int32_t, 3>> triangles;
  double area = 0, volume = 0;

  Surface(const PolygonMesh& mesh, const Vec3& middle) {
    for (const auto& t : triangulate(mesh).triangles) {
      triangles.push_back({t[0].value, t[1].value, t[2].value});
      const auto at = [&](int i) -> Vec3 { return mesh.positions[t[i].index()] - middle; };
      area += (at(1) - at(0)).cross(at(2) - at(0)).norm() / 2;
      volume += at(0).dot(at(1).cross(at(2))) / 6;
    }
  }
};

Vec3 middle_of(const PolygonMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Vec3& p : mesh.positions) box.extend(p);
  return box.isEmpty() ? Vec3(0, 0, 0) : Vec3(box.center());
}

double unchanged_share(const Character& a, const Character& b, const Correspondence& same, double diagonal) {
  constexpr double kSamePlace =
      1e-6;  // ours: of the diagonal; what a change of units leaves of 32-bit floats
  if (same.vertices.empty()) return 1;
  std::size_t unchanged = 0;
  for (std::size_t v = 0; v < same.vertices.size(); ++v)
    if (const VertexId image = same.vertices[v]; image.is_valid())
      unchanged += (a.mesh.positions[v] - b.mesh.positions[image.index()]).norm() <= kSamePlace * diagonal;
  return double(unchanged) / double(same.vertices.size());
}

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

std::vector<std::size_t> count_by_influences(const SkinWeights& weights) {
  std::vector<std::size_t> counts;
  for (std::size_t v = 0; v < weights.vertex_count(); ++v) {
    const std::size_t influences = weights.of(VertexId(v)).size();
    if (counts.size() <= influences) counts.resize(influences + 1);
    ++counts[influences];
  }
  return counts;
}

std::string heaviest_joint(const Character& character, VertexId vertex) {
  const auto row = character.weights.of(vertex);
  return row.empty() ? std::string() : character.skeleton[row.front().joint].name;
}

GeometryDiff compare_surfaces(const Character& a, const Character& b, const Correspondence& same,
                              double diagonal) {
  GeometryDiff diff;
  const Vec3 middle = middle_of(a.mesh);
  const Surface of_a(a.mesh, middle), of_b(b.mesh, middle);
  diff.area_a = of_a.area;
  diff.area_b = of_b.area;
  diff.volume_a = of_a.volume;
  diff.volume_b = of_b.volume;
  const auto is_unmatched = [](VertexId v) { return !v.is_valid(); };
  diff.unmatched_a =
      static_cast<std::size_t>(std::count_if(same.vertices.begin(), same.vertices.end(), is_unmatched));
  diff.unmatched_b =
      static_cast<std::size_t>(std::count_if(same.back.begin(), same.back.end(), is_unmatched));
  diff.unchanged = unchanged_share(a, b, same, diagonal);

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
  diff.influences_a = count_by_influences(a.weights);
  diff.influences_b = count_by_influences(b.weights);
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
