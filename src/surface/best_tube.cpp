#include "surface/best_tube.h"

#include "surface/quad_gate.h"
#include "surface/tube.h"

namespace skinforge {
namespace {

constexpr double kGoodQuality = 0.5;  // junction.md c: the target of the least scaled Jacobian
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
    if (!trouble.empty() || found <= quality) return;
    best = std::move(quads);
    quality = found;
  }
};

void try_tables(const QuadTube& tube, const DistanceField& field, const Projection& project, Choice& choice) {
  for (const double stack_cost : {10.0, 10.0 / 3, 30.0})  // junction.md b.2, step 6: the next-best tables
    for (const int more : {0, 1, -1, 2}) {
      if (choice.is_good()) return;
      if (auto quads = tube.with(tube.wanted_rows() + more, {.stack_cost = stack_cost}, project))
        choice.offer(*std::move(quads), field);
    }
}

}  // namespace

std::optional<QuadPatch> best_tube(const TrianglePatch& patch, const std::vector<JunctionLoop>& loops,
                                   const DistanceField& field, const Projection& project,
                                   std::string& fault) {
  Choice choice;
  const TrianglePatch fine = remesh(patch, project, {.length_scale = kDomainScale});
  for (const TubeDomain& domain : tube_domains(fine, loops))
    if (const auto tube = QuadTube::make(domain, choice.fault)) try_tables(*tube, field, project, choice);
  if (!choice.best) fault = choice.fault.empty() ? "the counts of its borders do not meet" : choice.fault;
  return choice.best;
}

}  // namespace skinforge
