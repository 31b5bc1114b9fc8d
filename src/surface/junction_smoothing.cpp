#include "surface/junction_smoothing.h"

#include <algorithm>
#include <set>

#include "geometry/scaled_jacobian.h"

namespace skinforge {
namespace {

constexpr double kStep = 0.5;           // ours: of the way to the neighbours' mean; stable on any graph
constexpr double kLeastJacobian = 0.2;  // junction.md (c): the gate of a tube

using Neighbours = std::vector<std::vector<std::int32_t>>;

// A quad as its halves say: the diagonal runs from corner 0 to corner 2 of both.
std::array<std::int32_t, 4> quad_of(const Junction& junction, std::size_t k) {
  const Triangle &first = junction.patch.triangles[2 * k], &second = junction.patch.triangles[2 * k + 1];
  return {first[0], first[1], first[2], second[2]};
}

Neighbours neighbours_of(const Junction& junction) {
  std::vector<std::set<std::int32_t>> sets(junction.patch.positions.size());
  const auto join = [&](auto&& face) {
    for (std::size_t k = 0; k < face.size(); ++k) {
      const std::int32_t a = face[k], b = face[(k + 1) % face.size()];
      sets[a].insert(b), sets[b].insert(a);
    }
  };
  for (std::size_t k = 0; k < junction.quads; ++k) join(quad_of(junction, k));
  for (std::size_t t = 2 * junction.quads; t < junction.patch.triangles.size(); ++t)
    join(junction.patch.triangles[t]);
  Neighbours all;
  for (const auto& set : sets) all.emplace_back(set.begin(), set.end());
  return all;
}

std::vector<std::array<std::int32_t, 4>> quads_of(const Junction& junction) {
  std::vector<std::array<std::int32_t, 4>> quads;
  for (std::size_t k = 0; k < junction.quads; ++k) quads.push_back(quad_of(junction, k));
  return quads;
}

double jacobian_of(const std::array<std::int32_t, 4>& q, const std::vector<Vec3>& p) {
  return scaled_jacobian_of_quad(p[q[0]], p[q[1]], p[q[2]], p[q[3]]);
}

// One round. Vertices of quads that it would make poor go back, and then those of quads that this makes poor;
// with all of them back nothing has changed, so it ends.
void relax(TrianglePatch& patch, const Neighbours& neighbours,
           const std::vector<std::array<std::int32_t, 4>>& quads) {
  const std::vector<Vec3> before = patch.positions;
  for (std::size_t v = patch.fixed; v < before.size(); ++v) {
    if (neighbours[v].empty()) continue;
    Vec3 mean = Vec3::Zero();
    for (const std::int32_t n : neighbours[v]) mean += before[n];
    mean /= static_cast<double>(neighbours[v].size());
    patch.positions[v] = before[v] + kStep * (mean - before[v]);
  }
  for (bool changed = true; changed;) {
    changed = false;
    std::set<std::int32_t> back;
    for (const auto& quad : quads)
      if (jacobian_of(quad, patch.positions) < std::min(kLeastJacobian, jacobian_of(quad, before)))
        back.insert(quad.begin(), quad.end());
    for (const std::int32_t v : back)
      if (patch.positions[v] != before[v]) patch.positions[v] = before[v], changed = true;
  }
}

}  // namespace

int smooth_junction(Junction& junction, const KeptSurface& kept, int rounds) {
  const Neighbours neighbours = neighbours_of(junction);
  const auto quads = quads_of(junction);
  for (; rounds > 0; rounds /= 2) {
    Junction smoothed = junction;
    for (int round = 0; round < rounds; ++round) relax(smoothed.patch, neighbours, quads);
    smoothed.faults = faults_of(smoothed.patch, smoothed.loops, kept);
    if (smoothed.faults > junction.faults) continue;
    junction = std::move(smoothed);
    return rounds;
  }
  return 0;
}

}  // namespace skinforge
