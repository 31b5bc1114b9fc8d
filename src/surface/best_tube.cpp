#include "surface/best_tube.h"

#include <algorithm>

#include "surface/quad_gate.h"
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

void try_tables(const QuadTube& tube, std::size_t borders, const DistanceField& field,
                const WantedSurface& surface, Choice& choice) {
  std::vector<std::pair<int, TubeTable>> tried;
  for (const TubeOptions& options : options_for(borders))
    for (const int more : {0, 1, -1, 2}) {
      const int rows = tube.wanted_rows() + more;
      const auto table = tube.table(rows, options);
      if (!table || std::find(tried.begin(), tried.end(), std::pair(rows, *table)) != tried.end()) continue;
      choice.offer(tube.made(*table, rows, surface), field);
      if (choice.is_good()) return;
      tried.emplace_back(rows, *table);
    }
}

}  // namespace

std::optional<QuadPatch> best_tube(const TrianglePatch& patch, const std::vector<JunctionLoop>& loops,
                                   const DistanceField& field, const WantedSurface& surface,
                                   std::string& fault) {
  Choice choice;
  const TrianglePatch fine = remesh(patch, surface.project, {.length_scale = kDomainScale});
  for (const TubeDomain& domain : tube_domains(fine, loops)) {
    if (const auto tube = QuadTube::make(domain, choice.fault))
      try_tables(*tube, loops.size(), field, surface, choice);
    if (choice.best) break;
  }
  if (!choice.best) fault = choice.fault.empty() ? "the counts of its borders do not meet" : choice.fault;
  return choice.best;
}

}  // namespace skinforge
