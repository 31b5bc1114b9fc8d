#include "welded_edges.h"

#include <algorithm>

#include "finished_character.h"

namespace skinforge::testing {
namespace {

// The number of the place of each point.
std::vector<std::size_t> places(const std::vector<Vec3>& points) {
  std::map<std::array<double, 3>, std::size_t> known;
  std::vector<std::size_t> numbers;
  for (const Vec3& p : points)
    numbers.push_back(known.try_emplace({p.x(), p.y(), p.z()}, known.size()).first->second);
  return numbers;
}

}  // namespace

WeldedEdges::WeldedEdges(const GltfEvaluator& glb) {
  const auto place = places(glb.bind_pose());
  for (const auto& triangle : glb.triangles()) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t from = place[triangle.vertices[k]], to = place[triangle.vertices[(k + 1) % 3]];
      Edge& edge = edges_[{std::min(from, to), std::max(from, to)}];
      ++(from < to ? edge.along : edge.against);
      edge.is_of_junction |= triangle.material == kJunctionMaterial;
    }
  }
}

template <class Predicate>
std::size_t WeldedEdges::count(const Predicate& predicate) const {
  return static_cast<std::size_t>(
      std::count_if(edges_.begin(), edges_.end(), [&](const auto& item) { return predicate(item.second); }));
}

std::size_t WeldedEdges::open_at_junctions() const {
  return count([](const Edge& e) { return e.is_of_junction && e.along + e.against == 1; });
}
std::size_t WeldedEdges::crowded_at_junctions() const {
  return count([](const Edge& e) { return e.is_of_junction && e.along + e.against > 2; });
}
std::size_t WeldedEdges::turned_at_junctions() const {
  return count([](const Edge& e) { return e.is_of_junction && e.along + e.against == 2 && e.along != 1; });
}
std::size_t WeldedEdges::odd() const {
  return count([](const Edge& e) { return e.along + e.against != 2; });
}

std::size_t odd_edges(const PolygonMesh& mesh) {
  const auto place = places(mesh.positions);
  std::map<std::array<std::size_t, 2>, int> faces;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto corners = mesh.face(FaceId(f));
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const std::size_t from = place[corners[k].index()],
                        to = place[corners[(k + 1) % corners.size()].index()];
      ++faces[{std::min(from, to), std::max(from, to)}];
    }
  }
  return static_cast<std::size_t>(
      std::count_if(faces.begin(), faces.end(), [](const auto& item) { return item.second != 2; }));
}

}  // namespace skinforge::testing
