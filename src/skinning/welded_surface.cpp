#include "skinning/welded_surface.h"

#include <algorithm>
#include <numeric>

namespace skinforge {
namespace {

using Place = std::array<float, 3>;

Place place_of(const Vec3& p) {
  return {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
}

// For each vertex the lowest vertex at its place, of those with its weights where there are any.
std::vector<std::size_t> first_at_place(std::span<const Vec3> positions, const SkinWeights* weights) {
  std::vector<std::size_t> order(positions.size()), first(positions.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return place_of(positions[a]) < place_of(positions[b]);
  });
  const auto has_same_row = [&](std::size_t a, std::size_t b) {
    return !weights || std::ranges::equal(weights->of(VertexId(a)), weights->of(VertexId(b)));
  };
  std::size_t group = 0;  // where the vertices of the current place begin
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (place_of(positions[order[i]]) != place_of(positions[order[group]])) group = i;
    std::size_t same = group;
    while (!has_same_row(order[same], order[i])) ++same;
    first[order[i]] = order[same];
  }
  return first;
}

}  // namespace

WeldedSurface weld_surface(std::span<const Vec3> positions, std::span<const VertexTriangle> triangles,
                           const SkinWeights* weights) {
  WeldedSurface surface;
  const std::vector<std::size_t> first = first_at_place(positions, weights);
  for (std::size_t v = 0; v < positions.size(); ++v) {
    if (first[v] == v) {
      surface.welded.emplace_back(surface.positions.size());
      surface.original.emplace_back(v);
      surface.positions.push_back(positions[v]);
    } else {
      surface.welded.push_back(surface.welded[first[v]]);
    }
  }
  for (VertexTriangle t : triangles) {
    for (VertexId& v : t) v = surface.welded[v.index()];
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) surface.triangles.push_back(t);
  }
  return surface;
}

Handles WeldedSurface::weld(const Handles& handles) const {
  Handles held(positions.size());
  std::vector<bool> is_disputed(positions.size(), false);
  for (std::size_t v = 0; v < handles.size(); ++v) {
    if (!handles[v].is_valid()) continue;
    JointId& here = held[welded[v].index()];
    if (here.is_valid() && here != handles[v]) is_disputed[welded[v].index()] = true;
    here = handles[v];
  }
  for (std::size_t v = 0; v < held.size(); ++v)
    if (is_disputed[v]) held[v] = JointId();
  return held;
}

Handles WeldedSurface::spread(const Handles& handles) const {
  Handles all;
  for (const VertexId v : welded) all.push_back(handles[v.index()]);
  return all;
}

SkinWeights WeldedSurface::spread(const SkinWeights& weights) const {
  SkinWeights all;
  for (const VertexId v : welded) all.push_row(weights.of(v));
  return all;
}

std::vector<Vec3> WeldedSurface::spread(std::span<const Vec3> points) const {
  std::vector<Vec3> all;
  for (const VertexId v : welded) all.push_back(points[v.index()]);
  return all;
}

SkinWeights WeldedSurface::gather(const SkinWeights& weights) const {
  SkinWeights firsts;
  for (const VertexId v : original) firsts.push_row(weights.of(v));
  return firsts;
}

std::vector<Vec3> WeldedSurface::gather(std::span<const Vec3> points) const {
  std::vector<Vec3> firsts;
  for (const VertexId v : original) firsts.push_back(points[v.index()]);
  return firsts;
}

}  // namespace skinforge
