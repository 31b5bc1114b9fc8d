#include "surface/junction_measures.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "geometry/edges.h"
#include "geometry/scaled_jacobian.h"
#include "geometry/self_intersection.h"
#include "surface/junction_normals.h"

namespace skinforge {
namespace {

/// One junction among the faces of the joined surface.
class Measuring {
 public:
  Measuring(const JoinedSurface& joined, std::int32_t site, const DistanceField* field)
      : joined_(joined),
        mesh_(joined.mesh),
        site_(site),
        field_(field && !field->values.empty() ? field : nullptr),
        edges_(build_edges(joined.mesh)) {}

  JunctionMeasures run() {
    for (std::size_t f = 0; f < mesh_.face_count(); ++f)
      if (is_new(FaceId(f))) measure_face(FaceId(f));
    for (const Edge& edge : edges_.edges) measure_edge(edge);
    measure_vertices();
    result_.components = count_components();
    result_.self_intersections = count_intersections();
    return std::move(result_);
  }

 private:
  bool is_new(FaceId f) const { return joined_.faces[f.index()].site == site_; }
  bool is_new_vertex(VertexId v) const {
    return !joined_.vertices[v.index()].source.is_valid() && joined_.vertices[v.index()].site == site_;
  }
  const Vec3& at(VertexId v) const { return mesh_.positions[v.index()]; }

  Vec3 centre(FaceId f) const {
    Vec3 sum = Vec3::Zero();
    for (const VertexId v : mesh_.face(f)) sum += at(v);
    return sum / static_cast<double>(mesh_.face(f).size());
  }

  void measure_face(FaceId f) {
    const auto face = mesh_.face(f);
    ++result_.faces;
    (face.size() == 4 ? result_.quads : result_.triangles) += 1;
    std::vector<Vec3> corners;
    double perimeter = 0;
    for (std::size_t k = 0; k < face.size(); ++k) {
      corners.push_back(at(face[k]));
      perimeter += (at(face[(k + 1) % face.size()]) - at(face[k])).norm();
    }
    const Vec3 area = area_normal(mesh_, f);
    constexpr double kNoArea = 1e-6;  // junction.md (c): of a squared edge
    const double edge = perimeter / static_cast<double>(face.size());
    result_.degenerate_faces += !(area.norm() > kNoArea * edge * edge);
    result_.scaled_jacobian.push_back(scaled_jacobian(corners));
    if (!field_) return;
    result_.folded_faces += area.dot(field_->gradient(centre(f))) < 0;
    result_.deviation.push_back(std::abs(field_->at(centre(f))) / field_->lattice.voxel);
  }

  void measure_edge(const Edge& edge) {
    std::vector<FaceId> made, preserved;
    for (const std::int32_t corner : edge.half_edges) {
      const FaceId f = edges_.face_of_corner[corner];
      (is_new(f) ? made : preserved).push_back(f);
    }
    if (made.empty()) return;
    result_.boundary_edges += edge.half_edges.size() == 1;
    result_.non_manifold_edges += edge.half_edges.size() > 2;
    if (made.size() != 1 || preserved.size() != 1) return;
    const Vec3 a = area_normal(mesh_, made[0]), b = area_normal(mesh_, preserved[0]);
    if (a.norm() > 0 && b.norm() > 0)
      result_.border_dihedral.push_back(std::acos(std::clamp(a.normalized().dot(b.normalized()), -1.0, 1.0)));
    border_edges_.push_back(edge.vertices);
  }

  // New edges that leave a border edge, against its length; valences of new vertices.
  void measure_vertices() {
    std::map<VertexId, std::pair<double, int>> leaving;
    std::map<VertexId, int> valence, triangles;
    for (const Edge& edge : edges_.edges) {
      const bool touches = std::any_of(edge.half_edges.begin(), edge.half_edges.end(),
                                       [&](std::int32_t c) { return is_new(edges_.face_of_corner[c]); });
      if (!touches) continue;
      const double length = (at(edge.vertices[1]) - at(edge.vertices[0])).norm();
      for (int end = 0; end < 2; ++end) {
        ++valence[edge.vertices[end]];
        if (is_new_vertex(edge.vertices[1 - end]))
          leaving[edge.vertices[end]].first += length, ++leaving[edge.vertices[end]].second;
      }
    }
    for (const auto& ends : border_edges_) {
      double sum = 0;
      int count = 0;
      for (const VertexId v : ends)
        if (const auto found = leaving.find(v); found != leaving.end())
          sum += found->second.first, count += found->second.second;
      const double length = (at(ends[1]) - at(ends[0])).norm();
      if (count > 0 && length > 0) result_.edge_length_ratio.push_back(sum / count / length);
    }
    for (std::size_t f = 0; f < mesh_.face_count(); ++f)
      if (is_new(FaceId(f)) && mesh_.face(FaceId(f)).size() == 3)
        for (const VertexId v : mesh_.face(FaceId(f))) ++triangles[v];
    for (const auto& [v, count] : valence)
      if (is_new_vertex(v)) {
        const int regular = triangles.contains(v) && 2 * triangles[v] > count ? 6 : 4;
        result_.irregular_vertices += count != regular;
        if (field_) result_.deviation.push_back(std::abs(field_->at(at(v))) / field_->lattice.voxel);
      }
  }

  std::size_t count_components() const {
    std::vector<Triangle> triangles;
    for (std::size_t f = 0; f < mesh_.face_count(); ++f) {
      const auto face = mesh_.face(FaceId(f));
      for (std::size_t k = 2; is_new(FaceId(f)) && k < face.size(); ++k)
        triangles.push_back({face[0].value, face[k - 1].value, face[k].value});
    }
    return static_cast<std::size_t>(triangle_components(triangles, mesh_.vertex_count()).second);
  }

  std::size_t count_intersections() const {
    const Triangulation all = triangulate(mesh_);
    std::vector<std::array<std::int32_t, 3>> triangles;
    std::vector<std::uint8_t> subset;
    for (std::size_t t = 0; t < all.triangles.size(); ++t) {
      const auto& c = all.triangles[t];
      triangles.push_back({c[0].value, c[1].value, c[2].value});
      subset.push_back(is_new(all.face[t]) ? 1 : 0);
    }
    return count_self_intersections(mesh_.positions, triangles, {subset});
  }

  const JoinedSurface& joined_;
  const PolygonMesh& mesh_;
  std::int32_t site_;
  const DistanceField* field_;
  EdgeList edges_;
  JunctionMeasures result_;
  std::vector<std::array<VertexId, 2>> border_edges_;
};

}  // namespace

JunctionMeasures measure_junction(const JoinedSurface& joined, std::int32_t site,
                                  const DistanceField* field) {
  JunctionMeasures measures = Measuring(joined, site, field).run();
  measures.border_normal_step = border_normal_steps(joined, site);
  return measures;
}

InheritedEdges inherited_edges(const JoinedSurface& joined) {
  const EdgeList edges = build_edges(joined.mesh);
  InheritedEdges inherited;
  for (const Edge& edge : edges.edges) {
    const bool in_junction = std::any_of(edge.half_edges.begin(), edge.half_edges.end(), [&](std::int32_t c) {
      return joined.faces[edges.face_of_corner[c].index()].site >= 0;
    });
    if (in_junction) continue;
    inherited.open += edge.half_edges.size() == 1;
    inherited.non_manifold += edge.half_edges.size() > 2;
  }
  return inherited;
}

}  // namespace skinforge
