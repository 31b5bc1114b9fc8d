#include "surface/best_tube.h"

#include <algorithm>
#include <functional>

#include "surface/half_tube.h"
#include "surface/quad_gate.h"
#include "surface/raise_worst.h"
#include "surface/remesh.h"
#include "surface/tube.h"

namespace skinforge {
namespace {

constexpr double kGoodQuality = 0.5;  // junction.md c: the target of the least scaled Jacobian
constexpr double kGain = 1e-3;        // ours: less is no gain, so equals do not hang on the last bit
constexpr double kDomainScale = 0.5;  // ours: of the edges of the patch that carries a tube's coordinates

// Keeps the best of the tubes that pass their gates.
struct Choice {
  std::optional<QuadPatch> best;
  double quality = 0;
  std::string fault;  // of the first that did not pass

  bool is_good() const { return quality >= kGoodQuality; }

  void offer(QuadPatch quads, const DistanceField& field) {
    const std::string trouble = fault_of(quads, field);
    if (fault.empty()) fault = trouble;
    const double found = least_scaled_jacobian(quads);
    if (!trouble.empty() || found <= quality + kGain) return;
    best = std::move(quads);
    quality = found;
  }
};

// Tables for one tube: junction.md b.2, step 6. Seams leave more ways to go on, and one table each is enough.
std::vector<TubeOptions> options_for(std::size_t borders) {
  if (borders > 2) return {{}};
  return {{}, {.stack_cost = 10.0 / 3}, {.stack_cost = 30}};
}

// How a tube gets its tables, and how one is made of them.
struct Maker {
  std::function<std::optional<TubeTable>(int rows, const TubeOptions&)> table;
  std::function<std::optional<QuadPatch>(const TubeTable&, int rows)> made;
};

void try_tables(const QuadTube& tube, const Maker& maker, std::size_t borders, const DistanceField& field,
                Choice& choice) {
  std::vector<std::pair<int, TubeTable>> tried;
  for (const TubeOptions& options : options_for(borders))
    for (const int more : {0, 1, -1, 2}) {
      const int rows = tube.wanted_rows() + more;
      const auto table = maker.table(rows, options);
      if (!table || std::find(tried.begin(), tried.end(), std::pair(rows, *table)) != tried.end()) continue;
      if (auto made = maker.made(*table, rows)) choice.offer(*std::move(made), field);
      if (choice.is_good()) return;
      tried.emplace_back(rows, *table);
    }
}

Maker any_tube(const QuadTube& tube, const WantedSurface& surface) {
  return {[&](int rows, const TubeOptions& options) { return tube.table(rows, options); },
          [&](const TubeTable& table, int rows) { return tube.made(table, rows, surface); }};
}

Maker symmetric_tube(const QuadTube& tube, const WantedSurface& surface, const PatchMirror& borders) {
  return {
      [&](int rows, const TubeOptions& options) { return tube.symmetric_table(rows, options, borders); },
      [&](const TubeTable& table, int rows) { return tube.made_symmetric(table, rows, surface, borders); }};
}

// A tube of the half above the plane, and its image.
Maker unfolded_tube(const QuadTube& tube, std::size_t on_plane, const WantedSurface& surface,
                    const PatchMirror& borders) {
  return {[&](int rows, const TubeOptions& options) { return tube.table(rows, options); },
          [&, on_plane](const TubeTable& table, int rows) {
            Unfolded whole = unfolded(tube.laid(table, rows), on_plane, borders);
            polish_symmetric(whole.patch, surface, whole.mirror);
            return whole.patch;
          }};
}

}  // namespace

std::optional<QuadPatch> best_tube(const TrianglePatch& patch, const std::vector<JunctionLoop>& loops,
                                   const DistanceField& field, const WantedSurface& surface,
                                   std::string& fault, const PatchMirror* mirror) {
  Choice choice;
  const TrianglePatch fine = remesh(patch, surface.project, {.length_scale = kDomainScale});
  const bool is_half = mirror && loops.size() > 2;
  const auto domains = is_half ? half_domains(fine, loops, *mirror) : tube_domains(fine, loops);
  for (const TubeDomain& domain : domains) {
    const auto tube = QuadTube::make(domain, choice.fault);
    if (!tube) continue;
    if (is_half)
      try_tables(*tube, unfolded_tube(*tube, domain.seams.size(), surface, *mirror), 2, field, choice);
    else
      try_tables(*tube, mirror ? symmetric_tube(*tube, surface, *mirror) : any_tube(*tube, surface),
                 loops.size(), field, choice);
    if (is_half ? choice.is_good() : choice.best.has_value()) break;
  }
  if (!choice.best) fault = choice.fault.empty() ? "the counts of its borders do not meet" : choice.fault;
  return choice.best;
}

}  // namespace skinforge
