#include "geometry/scalar_field.h"

#include <limits>
#include <queue>
#include <tuple>

#include "base/expect.h"

namespace skinforge {
namespace {

double mean_of(std::span<const VertexId> vertices, const std::vector<double>& values) {
  double sum = 0;
  for (const VertexId v : vertices) sum += values[v.index()];
  return sum / static_cast<double>(vertices.size());
}

}  // namespace

std::vector<double> smooth_scalar(const VertexGraph& graph, std::vector<double> values,
                                  std::span<const std::uint8_t> is_free, const SmoothingOptions& options) {
  SF_EXPECT(values.size() == is_free.size() && values.size() + 1 == graph.begin.size());
  std::vector<double> before;
  for (int pass = 0; pass < options.passes; ++pass) {
    before = values;
    for (std::size_t v = 0; v < values.size(); ++v) {
      const auto neighbours = graph.of(VertexId(v));
      if (!is_free[v] || neighbours.empty()) continue;
      values[v] = options.self_weight * before[v] + (1 - options.self_weight) * mean_of(neighbours, before);
    }
  }
  return values;
}

GeodesicDistance geodesic_distance(const VertexGraph& graph, std::span<const Vec3> positions,
                                   std::span<const VertexId> sources) {
  SF_EXPECT(positions.size() + 1 == graph.begin.size());
  GeodesicDistance result;
  result.distance.assign(positions.size(), std::numeric_limits<double>::infinity());
  result.source.resize(positions.size());
  using Label = std::tuple<double, VertexId, VertexId>;  // distance, source, vertex: the order settles ties
  std::priority_queue<Label, std::vector<Label>, std::greater<>> open;
  const auto offer = [&](double distance, VertexId source, VertexId v) {
    double& best = result.distance[v.index()];
    VertexId& best_source = result.source[v.index()];
    if (distance > best || (distance == best && best_source.is_valid() && source >= best_source)) return;
    best = distance;
    best_source = source;
    open.emplace(distance, source, v);
  };
  for (const VertexId s : sources) offer(0, s, s);
  while (!open.empty()) {
    const auto [distance, source, v] = open.top();
    open.pop();
    if (distance != result.distance[v.index()] || source != result.source[v.index()]) continue;  // outdated
    for (const VertexId n : graph.of(v))
      offer(distance + (positions[n.index()] - positions[v.index()]).norm(), source, n);
  }
  return result;
}

GeodesicDistance geodesic_distance(const PolygonMesh& mesh, std::span<const VertexId> sources) {
  return geodesic_distance(build_vertex_graph(mesh), mesh.positions, sources);
}

}  // namespace skinforge
