#include "stages/junction_rounds.h"

#include <fmt/format.h>

#include <optional>

namespace skinforge {
namespace {

// Strips between arcs of both sides; other arcs are counted in `open`.
void add_strips(Junction& junction, std::span<const JunctionLoop> arcs, const KeptSurface& kept, int& open) {
  junction.strips = arc_strips(arcs, open);
  for (const ArcStrip& strip : junction.strips) junction.faults += faults_of(strip.patch, strip.arcs, kept);
  if (junction.rung != JunctionRung::None || junction.strips.empty()) return;
  junction.rung = JunctionRung::Strip;
  junction.reason.clear();
}

// Of two junctions that are each other's images the second is the first one's image.
Junction make_junction(const JunctionSite& site, JunctionSymmetry symmetry, JunctionRound& round,
                       const KeptSurface& kept) {
  std::vector<JunctionLoop> arcs;
  auto loops = loops_of(round.sources, site, arcs);
  const auto own = static_cast<std::int32_t>(site.first());
  Junction junction;
  if (symmetry.site >= 0 && symmetry.site < own) {
    const Junction& other = round.junctions[static_cast<std::size_t>(symmetry.site)];
    junction = mirrored_junction(other, other.symmetry.borders, std::move(loops));
    junction.faults = faults_of(junction.patch, junction.loops, kept);
  } else {
    junction = build_junction(std::move(loops), *site.field, kept,
                              symmetry.site == own ? &symmetry.borders : nullptr);
  }
  junction.symmetry = std::move(symmetry);
  add_strips(junction, arcs, kept, round.arcs[site.first()]);
  return junction;
}

JunctionRound make_round(const std::vector<JunctionSite>& sites, const BuildSymmetry& symmetry,
                         const std::vector<PreservedSource>& sources, const KeptSurface& kept,
                         std::size_t operations) {
  JunctionRound round{sources, std::vector<Junction>(operations), std::vector<int>(operations, 0), {}};
  for (const JunctionSite& site : sites) {
    const std::size_t first = site.first();
    round.junctions[first] = make_junction(site, symmetry.of(site, sources), round, kept);
    round.faults += round.junctions[first].faults;
    for (const std::size_t other : site.group)
      if (other != first)
        round.junctions[other].reason = fmt::format("joined in the junction of operation {}", first + 1);
  }
  return round;
}

// Preserved faces that the junctions cut go; returns how many.
std::size_t discard_cut_faces(std::vector<PreservedSource>& sources, const std::vector<JunctionSite>& sites,
                              const JunctionRound& made, const KeptSurface& kept) {
  std::size_t discarded = 0;
  for (const JunctionSite& site : sites) {
    const Junction& junction = made.junctions[site.first()];
    if (junction.faults.self_intersections > 0)
      discarded += discard_faces(sources, site.solids.participants,
                                 faces_cut_by(junction.patch, junction.loops, kept), site.first());
  }
  return discarded;
}

}  // namespace

JunctionRound make_junctions(const std::vector<JunctionSite>& sites, std::vector<PreservedSource> sources,
                             std::size_t operations, const PreserveOptions& options) {
  constexpr int kRounds = 4;  // ours: later rounds found nothing on the real characters
  for (const JunctionSite& site : sites)
    discard_moved_faces(sources, site.solids.participants, site.solids.solids, *site.field, site.first(),
                        options);
  BuildSymmetry symmetry(sites, sources);
  std::optional<JunctionRound> best;
  for (int round = 0; round < kRounds; ++round) {
    sources = symmetry.cleaned(std::move(sources), options);
    const KeptSurface kept = kept_surface(sources);
    JunctionRound made = make_round(sites, symmetry, sources, kept, operations);
    const std::size_t discarded = discard_cut_faces(sources, sites, made, kept);
    if (!best || made.faults < best->faults) best = std::move(made);
    if (discarded == 0) break;
  }
  return std::move(*best);
}

}  // namespace skinforge
