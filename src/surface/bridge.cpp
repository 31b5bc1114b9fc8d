#include "surface/bridge.h"

#include <algorithm>
#include <set>

#include "surface/borders.h"
#include "surface/chords.h"
#include "surface/fairing.h"
#include "surface/remesh.h"

namespace skinforge {
namespace {

std::vector<Support> supports_of(const std::vector<JunctionLoop>& loops) {
  std::vector<Support> supports;
  std::int32_t fixed = 0;
  for (const JunctionLoop& loop : loops) {
    for (const auto& inward : loop.inward) {
      for (const Vec3& p : inward) supports.push_back({fixed, p});
      ++fixed;
    }
  }
  return supports;
}

Vec3 centre_of(const JunctionLoop& loop) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& p : loop.positions) sum += p;
  return sum / static_cast<double>(loop.positions.size());
}

// Host and donor borders in pairs, nearest centres first; what stays single is capped.
std::vector<std::pair<std::size_t, std::size_t>> nearest_pairs(const std::vector<JunctionLoop>& loops) {
  std::vector<std::pair<double, std::pair<std::size_t, std::size_t>>> candidates;
  for (std::size_t i = 0; i < loops.size(); ++i)
    for (std::size_t j = 0; j < loops.size(); ++j)
      if (loops[i].is_host && !loops[j].is_host)
        candidates.push_back({(centre_of(loops[i]) - centre_of(loops[j])).norm(), {i, j}});
  std::stable_sort(candidates.begin(), candidates.end());
  std::set<std::size_t> taken;
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (const auto& [distance, pair] : candidates) {
    if (taken.contains(pair.first) || taken.contains(pair.second)) continue;
    taken.insert({pair.first, pair.second});
    pairs.push_back(pair);
  }
  return pairs;
}

}  // namespace

bool can_bridge_all(const std::vector<JunctionLoop>& loops) {
  return 2 * nearest_pairs(loops).size() == loops.size();
}

TrianglePatch bridge_or_cap(const std::vector<JunctionLoop>& loops, bool is_fair) {
  Borders borders = lay_borders(loops);
  TrianglePatch patch = std::move(borders.patch);
  std::set<std::size_t> joined;
  for (const auto& [host, donor] : nearest_pairs(loops)) {
    IndexLoop ring = borders.loops[donor];
    std::reverse(ring.begin(),
                 ring.end());  // new faces run along a border; a zip wants its second ring the other way
    add_zip(patch, borders.loops[host], ring, nullptr);
    joined.insert({host, donor});
  }
  for (std::size_t l = 0; l < loops.size(); ++l)
    if (!joined.contains(l)) add_fill(patch, borders.loops[l]);
  patch = remesh(split_chords(std::move(patch)), nullptr);
  return is_fair ? fair(patch, supports_of(loops)) : patch;
}

}  // namespace skinforge
