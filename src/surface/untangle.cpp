#include "surface/untangle.h"

#include <set>

#include "surface/junction_faults.h"

namespace skinforge {
namespace {

constexpr int kRounds = 8;  // ours: what has not come apart by then does not

std::vector<std::set<std::int32_t>> neighbours_of(const TrianglePatch& patch) {
  std::vector<std::set<std::int32_t>> neighbours(patch.positions.size());
  for (const Triangle& t : patch.triangles)
    for (int k = 0; k < 3; ++k) neighbours[t[k]].insert({t[(k + 1) % 3], t[(k + 2) % 3]});
  return neighbours;
}

}  // namespace

TrianglePatch untangled(TrianglePatch patch, const std::vector<JunctionLoop>& loops,
                        const KeptSurface& kept) {
  const auto neighbours = neighbours_of(patch);
  for (int round = 0; round < kRounds; ++round) {
    std::set<std::int32_t> tangled;
    for (const std::int32_t t : intersecting_triangles(patch, loops, kept))
      for (const std::int32_t v : patch.triangles[t])
        if (static_cast<std::size_t>(v) >= patch.fixed) tangled.insert(v);
    if (tangled.empty()) break;
    const std::vector<Vec3> before = patch.positions;
    for (const std::int32_t v : tangled) {
      Vec3 sum = Vec3::Zero();
      for (const std::int32_t n : neighbours[v]) sum += before[n];
      patch.positions[v] = sum / static_cast<double>(neighbours[v].size());
    }
  }
  return patch;
}

}  // namespace skinforge
