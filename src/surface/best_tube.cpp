#include "surface/best_tube.h"

#include <algorithm>
#include <span>

#include "surface/junction_faults.h"
#include "surface/quad_gate.h"
#include "surface/remesh.h"
#include "surface/tube.h"
#include "surface/untangle.h"

namespace skinforge {
namespace {

constexpr double kGoodLeast = 0.5, kGoodMean = 0.85;  // junction.md c: of the scaled Jacobian
constexpr double kGain = 1e-3;        // ours: less is no gain, so equals do not hang on the last bit
constexpr double kDomainScale = 0.5;  // ours: of the edges of the patch that carries a tube's coordinates

// Keeps the best of the tubes that pass their gates.
class Choice {
 public:
  explicit Choice(const TubeProblem& problem) : problem_(problem) {}

  bool is_good() const { return score_ >= kGoodLeast + kGoodMean; }
  const std::optional<QuadPatch>& best() const { return best_; }
  const std::string& fault() const { return fault_; }
  void note(const std::string& trouble) {
    if (fault_.empty()) fault_ = trouble;
  }

  void offer(QuadPatch quads) {
    if (!is_gain(quads)) return;
    if (faults_of(halved(quads), problem_.loops, problem_.kept).any()) {
      quads.positions = untangled(halved(quads), problem_.loops, problem_.kept).positions;
      if (!is_gain(quads)) return;
      const JunctionFaults faults = faults_of(halved(quads), problem_.loops, problem_.kept);
      if (faults.any()) return note(describe(faults));
    }
    score_ = score_of(quads);
    best_ = std::move(quads);
  }

 private:
  // What is more than good in one respect does not make up for less in the other.
  static double score_of(const QuadPatch& quads) {
    return std::min(least_scaled_jacobian(quads), kGoodLeast) +
           std::min(mean_scaled_jacobian(quads), kGoodMean);
  }

  bool is_gain(const QuadPatch& quads) {
    const std::string trouble = fault_of(quads, problem_.field);
    if (!trouble.empty()) note(trouble);
    return trouble.empty() && score_of(quads) > score_ + kGain;
  }

  const TubeProblem& problem_;
  std::optional<QuadPatch> best_;
  double score_ = 0;
  std::string fault_;  // of the first that did not pass
};

// Tables for one tube: junction.md b.2, step 6. Seams leave more ways to go on, and one table each is enough.
std::span<const TubeOptions> options_for(std::size_t borders) {
  static constexpr TubeOptions kOptions[] = {{}, {.stack_cost = 10.0 / 3}, {.stack_cost = 30}};
  return std::span(kOptions).first(borders > 2 ? 1 : 3);
}

// Rows more than the borders' pace asks for: a few where they are deep beside the shape that they follow.
constexpr int kMoreRows[] = {0, 1, -1, 2, 3, 4};

void try_tables(const QuadTube& tube, const TubeProblem& problem, Choice& choice) {
  std::vector<std::pair<int, TubeTable>> tried;
  for (const TubeOptions& options : options_for(problem.loops.size()))
    for (const int more : kMoreRows) {
      const int rows = tube.wanted_rows() + more;
      const auto table = tube.table(rows, options);
      if (!table || std::find(tried.begin(), tried.end(), std::pair(rows, *table)) != tried.end()) continue;
      for (const bool is_polished : {true, false}) {
        choice.offer(tube.made(*table, rows, problem.surface, is_polished));
        if (choice.is_good()) return;
      }
      tried.emplace_back(rows, *table);
    }
}

}  // namespace

std::optional<QuadPatch> best_tube(const TrianglePatch& patch, const TubeProblem& problem,
                                   std::string& fault) {
  Choice choice(problem);
  const TrianglePatch fine = remesh(patch, problem.surface.project, {.length_scale = kDomainScale});
  for (const TubeDomain& domain : tube_domains(fine, problem.loops)) {
    std::string trouble;
    if (const auto tube = QuadTube::make(domain, trouble))
      try_tables(*tube, problem, choice);
    else
      choice.note(trouble);
    if (choice.best()) break;
  }
  if (!choice.best())
    fault = choice.fault().empty() ? "the counts of its borders do not meet" : choice.fault();
  return choice.best();
}

}  // namespace skinforge
