#include "surface/bridge.h"

#include <algorithm>
#include <set>

#include "surface/borders.h"
#include "surface/chords.h"
#include "surface/fairing.h"
#include "surface/nearest_pairs.h"
#include "surface/remesh.h"

namespace skinforge {
namespace {

// The connected piece of the preserved faces that each loop bounds.
std::vector<std::int32_t> pieces_of(const std::vector<JunctionLoop>& loops, const KeptSurface& kept) {
  const auto [component, count] = triangle_components(kept.triangles, kept.positions.size());
  std::vector<std::int32_t> of_vertex(kept.positions.size(), -1);
  for (std::size_t t = 0; t < kept.triangles.size(); ++t)
    for (const std::int32_t v : kept.triangles[t]) of_vertex[v] = component[t];
  std::vector<std::int32_t> pieces;
  for (const JunctionLoop& loop : loops)
    pieces.push_back(of_vertex[kept.vertex(loop.source, loop.vertices.front())]);
  return pieces;
}

}  // namespace

bool bridge_joins_all(const std::vector<JunctionLoop>& loops, const KeptSurface& kept) {
  const std::vector<std::int32_t> piece = pieces_of(loops, kept);
  const auto pairs = nearest_pairs(loops);
  return std::all_of(piece.begin(), piece.end(), [&](std::int32_t wanted) {
    return std::any_of(pairs.begin(), pairs.end(), [&](const auto& pair) {
      return piece[pair.first] == wanted || piece[pair.second] == wanted;
    });
  });
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
