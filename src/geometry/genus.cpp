#include "geometry/genus.h"

#include "geometry/disjoint_sets.h"
#include "geometry/edges.h"

namespace skinforge {

namespace {
struct Component {
  std::int64_t euler = 0;  // of its faces, edges and fans
  std::size_t loops = 0;
  bool is_manifold = true;
};

// Faces joined by edges, and corners of one fan.
class Joined {
 public:
  explicit Joined(const PolygonMesh& mesh)
      : edges_(build_edges(mesh)),
        faces_(mesh.face_count()),
        fans_(mesh.corner_count()),
        loops_(mesh.corner_count()),
        has_boundary_(mesh.corner_count(), false),
        components_(mesh.face_count()) {
    for (const Edge& edge : edges_.edges) join(edge);
    for (const Edge& edge : edges_.edges) judge(mesh, edge);
    for (std::size_t f = 0; f < mesh.face_count(); ++f) ++components_[faces_.root(int(f))].euler;
    for (std::size_t c = 0; c < mesh.corner_count(); ++c) count_corner(static_cast<std::int32_t>(c));
  }

  SurfaceGenus sum() const {
    SurfaceGenus total;
    for (std::size_t f = 0; f < components_.size(); ++f) {
      if (!faces_.is_root(static_cast<std::int32_t>(f))) continue;
      const Component& component = components_[f];
      if (!component.is_manifold) {
        ++total.non_manifold;
        continue;
      }
      ++(component.loops == 0 ? total.closed : total.open);
      total.boundary_loops += component.loops;
      total.handles +=
          static_cast<std::size_t>((2 - component.euler - static_cast<std::int64_t>(component.loops)) / 2);
    }
    return total;
  }

 private:
  Component& component_at(std::int32_t corner) {
    return components_[faces_.root(edges_.face_of_corner[corner].value)];
  }
  static bool has_length(const Edge& edge) { return edge.vertices[0] != edge.vertices[1]; }

  void join(const Edge& edge) {
    for (const std::int32_t c : edge.half_edges) {
      const std::int32_t first = edge.half_edges[0];
      if (!has_length(edge)) {
        fans_.unite(c, edges_.next_corner[c]);
        continue;
      }
      faces_.unite(edges_.face_of_corner[first].value, edges_.face_of_corner[c].value);
      if (c == first) continue;
      fans_.unite(first, edges_.next_corner[c]);
      fans_.unite(edges_.next_corner[first], c);
    }
  }

  // Beyond two faces, and of two that run the same way, the fans are wrong, but then nobody asks for them.
  void judge(const PolygonMesh& mesh, const Edge& edge) {
    if (!has_length(edge)) return;
    const std::int32_t first = edge.half_edges[0];
    Component& component = component_at(first);
    --component.euler;
    const std::size_t sides = edge.half_edges.size();
    if (sides > 2 || (sides == 2 && mesh.corners[first] == mesh.corners[edge.half_edges[1]]))
      component.is_manifold = false;
    if (sides != 1) return;
    const std::int32_t begin = fans_.root(first), end = fans_.root(edges_.next_corner[first]);
    loops_.unite(begin, end);
    has_boundary_[begin] = has_boundary_[end] = true;
  }

  void count_corner(std::int32_t corner) {
    if (!fans_.is_root(corner)) return;
    ++component_at(corner).euler;
    component_at(corner).loops += has_boundary_[corner] && loops_.is_root(corner);
  }

  EdgeList edges_;
  DisjointSets faces_, fans_, loops_;  // loops: of fans that an open edge joins
  std::vector<bool> has_boundary_;     // per fan
  std::vector<Component> components_;  // at the root of its faces
};
}  // namespace

SurfaceGenus measure_genus(const PolygonMesh& mesh) {
  return Joined(mesh).sum();
}

}  // namespace skinforge
