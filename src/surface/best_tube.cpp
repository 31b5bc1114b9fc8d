#include "surface/best_tube.h"

#include "surface/quad_gate.h"
#include "surface/tube.h"

namespace skinforge {
namespace {

constexpr double kGoodQuality = 0.5;  // junction.md c: the target of the least scaled Jacobian
constexpr double kDomainScale = 0.5;  // ours: of the edges of the patch that carries a tube's coordinates

}  // namespace

std::optional<QuadPatch> best_tube(const TrianglePatch& patch, const std::vector<JunctionLoop>& loops,
                                   const DistanceField& field, const Projection& project,
                                   std::string& fault) {
  const TrianglePatch domain = remesh(patch, project, {.length_scale = kDomainScale});
  const auto tube = QuadTube::make(domain, loops, fault);
  if (!tube) return std::nullopt;
  std::optional<QuadPatch> best;
  double best_quality = 0;
  for (const double stack_cost : {10.0, 10.0 / 3, 30.0})  // junction.md b.2, step 6: the next-best tables
    for (const int more : {0, 1, -1, 2}) {
      auto quads = tube->with(tube->wanted_rows() + more, {.stack_cost = stack_cost}, project);
      if (!quads) continue;
      const std::string trouble = fault_of(*quads, field);
      if (fault.empty()) fault = trouble;
      const double quality = least_scaled_jacobian(*quads);
      if (!trouble.empty() || quality <= best_quality) continue;
      best = std::move(quads);
      best_quality = quality;
      if (quality >= kGoodQuality) return best;
    }
  if (!best && fault.empty()) fault = "the counts of its borders do not meet in the rows between them";
  return best;
}

}  // namespace skinforge
