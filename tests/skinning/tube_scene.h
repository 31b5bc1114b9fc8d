#pragma once

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "skinning/junction_shares.h"

namespace skinforge::testing {

/// A tube along x: `rings` rings of `around` vertices, ring r at x = first + r * step, quads between
/// neighbours.
inline PolygonMesh tube(int rings, int around, double first, double step, double radius) {
  PolygonMesh mesh;
  for (int r = 0; r < rings; ++r)
    for (int a = 0; a < around; ++a) {
      const double angle = 2 * std::numbers::pi * a / around;
      mesh.positions.emplace_back(first + r * step, radius * std::cos(angle), radius * std::sin(angle));
    }
  mesh.face_begin = {0};
  for (int r = 0; r + 1 < rings; ++r)
    for (int a = 0; a < around; ++a) {
      const int b = (a + 1) % around;
      for (const int v : {r * around + a, r * around + b, (r + 1) * around + b, (r + 1) * around + a})
        mesh.corners.push_back(VertexId(v));
      mesh.face_begin.push_back(static_cast<std::int32_t>(mesh.corners.size()));
      mesh.face_material.push_back(MaterialId(0));
      mesh.face_part.push_back(PartId(0));
    }
  mesh.parts.push_back({"tube", 0, false, false});
  return mesh;
}

/// One placed tube with all that `SourceSurface` points to.
struct TubeSource {
  PolygonMesh mesh;
  Triangulation triangles;
  std::unique_ptr<TriangleBvh> bvh;
  std::vector<double> presence;
  SkinWeights weights;
  JointMap map;
  bool attached = false;

  SourceSurface surface() const {
    return {mesh.positions, &triangles, bvh.get(), presence, &weights, &map, attached};
  }
};

/// `presence_of(x)` and `row_of(x)` say presence and weights of the ring at x.
template <class PresenceOf, class RowOf>
TubeSource tube_source(PolygonMesh mesh, const JointMap& map, PresenceOf presence_of, RowOf row_of) {
  TubeSource source;
  source.mesh = std::move(mesh);
  source.triangles = triangulate(source.mesh);
  std::vector<std::array<std::int32_t, 3>> soup;
  for (const auto& t : source.triangles.triangles) soup.push_back({t[0].value, t[1].value, t[2].value});
  source.bvh = std::make_unique<TriangleBvh>(source.mesh.positions, soup);
  for (const Vec3& p : source.mesh.positions) {
    source.presence.push_back(presence_of(p.x()));
    source.weights.push_row(row_of(p.x()));
  }
  source.map = map;
  return source;
}

/// Two tubes on one axis that were replaced at x = 0: source 0 covers x in [-5, 2] and is preserved up to x =
/// -2, source 1 covers [-2, 5] and is preserved from x = 2 on; the junction has the rings x = -1, 0, 1.
/// Joints: source 0 has body (0) and stump (1), source 1 has stump (0) and tip (1); result body 0, fused 1,
/// tip 2.
struct TubeScene {
  static constexpr int kAround = 8;
  std::vector<TubeSource> sources;
  PolygonMesh result;
  std::vector<VertexOrigin> origins;
  VertexGraph graph;

  ResultSurface surface() const { return {result.positions, origins, &graph}; }
  std::vector<SourceSurface> surfaces() const {
    std::vector<SourceSurface> list;
    for (const TubeSource& s : sources) list.push_back(s.surface());
    return list;
  }
};

inline std::vector<Influence> two_joint_row(double first_weight) {
  return normalised_row({{JointId(0), first_weight}, {JointId(1), 1 - first_weight}});
}

inline TubeScene replaced_tubes() {
  const auto falling = [](double x) { return std::clamp(0.5 - x / 4, 0.0, 1.0); };  // 1 at x = -2, 0 at x = 2
  TubeScene scene;
  scene.sources.push_back(tube_source(tube(8, TubeScene::kAround, -5, 1, 1),
                                      {{JointId(0), 1}, {JointId(1), 1}}, falling,
                                      [&](double x) { return two_joint_row(falling(x + 1)); }));
  scene.sources.push_back(tube_source(
      tube(8, TubeScene::kAround, -2, 1, 1), {{JointId(1), 1}, {JointId(2), 1}},
      [&](double x) { return 1 - falling(x); }, [&](double x) { return two_joint_row(falling(x - 1)); }));
  scene.result = tube(11, TubeScene::kAround, -5, 1, 1);
  for (int v = 0; v < 11 * TubeScene::kAround; ++v) {
    const int ring = v / TubeScene::kAround;
    if (ring <= 3)
      scene.origins.push_back({SourceId(0), VertexId(v)});
    else if (ring >= 7)
      scene.origins.push_back({SourceId(1), VertexId(v - 3 * TubeScene::kAround)});
    else
      scene.origins.push_back({});
  }
  scene.graph = build_vertex_graph(scene.result);
  return scene;
}

}  // namespace skinforge::testing
