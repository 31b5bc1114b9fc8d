#include "surface/junction_faults.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>

#include "geometry/self_intersection.h"

namespace skinforge {
namespace {

// The patch, and the preserved triangles near it, over one list of positions.
struct Neighbourhood {
  std::vector<Vec3> positions;
  std::vector<Triangle> triangles;  // those of the patch first
  std::vector<std::uint8_t> is_new;
  std::vector<std::pair<SourceId, FaceId>> origin;  // of the preserved ones
};

Neighbourhood neighbourhood(const TrianglePatch& patch, const std::vector<JunctionLoop>& loops,
                            const KeptSurface& kept) {
  Neighbourhood result{kept.positions, {}, {}, {}};
  std::vector<std::int32_t> name;  // of each vertex of the patch
  for (const JunctionLoop& loop : loops)
    for (const VertexId v : loop.vertices) name.push_back(kept.vertex(loop.source, v));
  Eigen::AlignedBox3d box;
  for (const Vec3& p : patch.positions) box.extend(p);
  for (std::size_t v = patch.fixed; v < patch.positions.size(); ++v) {
    name.push_back(static_cast<std::int32_t>(result.positions.size()));
    result.positions.push_back(patch.positions[v]);
  }
  for (const Triangle& t : patch.triangles) result.triangles.push_back({name[t[0]], name[t[1]], name[t[2]]});
  result.is_new.assign(result.triangles.size(), 1);
  for (const std::int32_t t : kept.bvh.overlapping(box.min(), box.max()))
    result.triangles.push_back(kept.triangles[t]), result.origin.push_back(kept.origin[t]);
  result.is_new.resize(result.triangles.size(), 0);
  return result;
}

std::size_t count_non_manifold(const Neighbourhood& all) {
  struct Uses {
    int count = 0;
    bool has_new = false;
  };
  std::map<std::pair<std::int32_t, std::int32_t>, Uses> edges;
  for (std::size_t i = 0; i < all.triangles.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      const Triangle& t = all.triangles[i];
      Uses& uses = edges[std::minmax(t[k], t[(k + 1) % 3])];
      ++uses.count;
      uses.has_new |= all.is_new[i] != 0;
    }
  return static_cast<std::size_t>(std::count_if(
      edges.begin(), edges.end(), [](const auto& e) { return e.second.has_new && e.second.count > 2; }));
}

bool is_degenerate_face(const TrianglePatch& patch, const Triangle& t) {
  constexpr double kNoArea = 1e-6;
  const Vec3 a = patch.positions[t[1]] - patch.positions[t[0]],
             b = patch.positions[t[2]] - patch.positions[t[0]];
  const double longest = std::max({a.squaredNorm(), b.squaredNorm(), (a - b).squaredNorm()});
  return !(0.5 * a.cross(b).norm() > kNoArea * longest);
}

}  // namespace

JunctionFaults& JunctionFaults::operator+=(const JunctionFaults& other) {
  non_manifold_edges += other.non_manifold_edges;
  self_intersections += other.self_intersections;
  degenerate_faces += other.degenerate_faces;
  return *this;
}

std::vector<std::pair<SourceId, FaceId>> faces_cut_by(const TrianglePatch& patch,
                                                      const std::vector<JunctionLoop>& loops,
                                                      const KeptSurface& kept) {
  const Neighbourhood all = neighbourhood(patch, loops, kept);
  std::vector<std::pair<SourceId, FaceId>> faces;
  for (const auto& [a, b] : self_intersections(all.positions, all.triangles, {all.is_new}))
    if (static_cast<std::size_t>(b) >= patch.triangles.size())  // the higher is the preserved one
      faces.push_back(all.origin[static_cast<std::size_t>(b) - patch.triangles.size()]);
  return faces;
}

std::set<std::int32_t> intersecting_triangles(const TrianglePatch& patch,
                                              const std::vector<JunctionLoop>& loops,
                                              const KeptSurface& kept) {
  const Neighbourhood all = neighbourhood(patch, loops, kept);
  std::set<std::int32_t> triangles;
  for (const auto& [a, b] : self_intersections(all.positions, all.triangles, {all.is_new}))
    for (const auto t : {a, b})
      if (static_cast<std::size_t>(t) < patch.triangles.size())
        triangles.insert(static_cast<std::int32_t>(t));
  return triangles;
}

JunctionFaults faults_of(const TrianglePatch& patch, const std::vector<JunctionLoop>& loops,
                         const KeptSurface& kept) {
  const Neighbourhood all = neighbourhood(patch, loops, kept);
  JunctionFaults faults;
  faults.non_manifold_edges = count_non_manifold(all);
  faults.self_intersections = count_self_intersections(all.positions, all.triangles, {all.is_new});
  faults.degenerate_faces = static_cast<std::size_t>(
      std::count_if(patch.triangles.begin(), patch.triangles.end(),
                    [&](const Triangle& t) { return is_degenerate_face(patch, t); }));
  return faults;
}

std::string describe(const JunctionFaults& f) {
  return fmt::format("{} non-manifold edges, {} self-intersections, {} degenerate faces",
                     f.non_manifold_edges, f.self_intersections, f.degenerate_faces);
}

}  // namespace skinforge
