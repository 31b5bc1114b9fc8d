#include "surface/best_tube.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <initializer_list>
#include <span>

#include "surface/half_tube.h"
#include "surface/improve_faces.h"
#include "surface/junction_faults.h"
#include "surface/quad_gate.h"
#include "surface/remesh.h"
#include "surface/tube.h"
#include "surface/untangle.h"

namespace skinforge {
namespace {

constexpr double kGoodLeast = 0.5, kGoodMean = 0.85;  // junction.md c: of the scaled Jacobian
constexpr double kMeanWeight = 2;  // ours: once the least passes, how even all faces are shows more
// Ours: more than the gate of the rung asks for. What is poorer among seams hangs on the last bit of the
// inputs: composite had 503 or 657 faces of 0.2 to 0.28, depending on its size.
constexpr double kLeastWithSeams = 0.3;
constexpr double kGain = 1e-3;        // ours: less is no gain, so equals do not hang on the last bit
constexpr double kDomainScale = 0.5;  // ours: of the edges of the patch that carries a tube's coordinates

// A tube as it lies on its domain, and what mirroring does to it if it is to be symmetric.
struct LaidTube {
  QuadPatch patch;
  std::optional<PatchMirror> mirror;
};

// Keeps the best of the tubes that pass their gates.
class Choice {
 public:
  explicit Choice(const TubeProblem& problem) : problem_(problem) {}

  bool is_good() const { return score_ >= kGoodLeast + kMeanWeight * kGoodMean; }
  const std::optional<LaidTube>& best() const { return best_; }
  const std::string& fault() const { return fault_; }
  void note(const std::string& trouble) {
    if (fault_.empty()) fault_ = trouble;
  }

  void offer(LaidTube tube) {
    QuadPatch& quads = tube.patch;
    if (!is_gain(quads)) return;
    if (faults_of(halved(quads), problem_.loops, problem_.kept).any()) {
      quads.positions = untangled(halved(quads), problem_.loops, problem_.kept).positions;
      if (!is_gain(quads)) return;
      const JunctionFaults faults = faults_of(halved(quads), problem_.loops, problem_.kept);
      if (faults.any()) return note(describe(faults));
    }
    score_ = score_of(quads);
    best_ = std::move(tube);
  }

 private:
  // What is more than good in one respect does not make up for less in the other.
  static double score_of(const QuadPatch& quads) {
    return std::min(least_scaled_jacobian(quads), kGoodLeast) +
           kMeanWeight * std::min(mean_scaled_jacobian(quads), kGoodMean);
  }

  bool is_gain(const QuadPatch& quads) {
    const double score = score_of(quads);
    if (best_ && score <= score_ + kGain) return false;
    std::string trouble = fault_of(quads, problem_.field);
    const double least = least_scaled_jacobian(quads);
    if (trouble.empty() && problem_.loops.size() > 2 && least < kLeastWithSeams)
      trouble = fmt::format("least scaled Jacobian {:.2f}", least);
    if (!trouble.empty()) note(trouble);
    return trouble.empty() && score > score_ + kGain;
  }

  const TubeProblem& problem_;
  std::optional<LaidTube> best_;
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

// Where the first table gives faces as bad as this, other rows do not mend them (ours: a least scaled
// Jacobian).
constexpr double kHopeless = -0.3;

// How a tube gets its tables, and how one is made of them.
struct Maker {
  std::function<std::optional<TubeTable>(int rows, const TubeOptions&)> table;
  std::function<std::optional<LaidTube>(const TubeTable&, int rows)> laid;
};

Maker any_tube(const QuadTube& tube) {
  return {[&](int rows, const TubeOptions& options) { return tube.table(rows, options); },
          [&](const TubeTable& table, int rows) {
            return LaidTube{tube.laid(table, rows), std::nullopt};
          }};
}

Maker symmetric_tube(const QuadTube& tube, const PatchMirror& borders) {
  return {[&](int rows, const TubeOptions& options) { return tube.symmetric_table(rows, options, borders); },
          [&](const TubeTable& table, int rows) -> std::optional<LaidTube> {
            LaidTube laid{tube.laid(table, rows), std::nullopt};
            laid.mirror = mirror_of(laid.patch, borders);
            if (!laid.mirror) return std::nullopt;
            return laid;
          }};
}

// A tube of the half above the plane, and its image.
Maker unfolded_tube(const QuadTube& tube, std::size_t on_plane, const PatchMirror& borders) {
  return {[&](int rows, const TubeOptions& options) { return tube.table(rows, options); },
          [&, on_plane](const TubeTable& table, int rows) {
            Unfolded whole = unfolded(tube.laid(table, rows), on_plane, borders);
            return LaidTube{std::move(whole.patch), std::move(whole.mirror)};
          }};
}

// Moves a tube's vertices for one goal after the other and offers it each time, until there is a good one.
// Returns the least scaled Jacobian that came of it.
double improve_and_offer(LaidTube& tube, std::initializer_list<FaceGoal> goals, const WantedSurface& wanted,
                         Choice& choice) {
  double least = -1;
  for (const FaceGoal goal : goals) {
    improve_faces(tube.patch, wanted, goal, tube.mirror ? &*tube.mirror : nullptr);
    least = std::max(least, least_scaled_jacobian(tube.patch));
    choice.offer(tube);
    if (choice.is_good()) break;
  }
  return least;
}

WantedSurface wanted_for(const LaidTube& tube, const WantedSurface& surface) {
  return tube.mirror ? mirrored(surface, tube.mirror->plane) : surface;
}

// Places for a tube's vertices: where all faces are good, then where the worst are. Smoothing before that
// serves all but thin and sharp shapes.
double offer_places(LaidTube tube, const WantedSurface& surface, bool is_polished, Choice& choice) {
  const WantedSurface wanted = wanted_for(tube, surface);
  if (tube.mirror) make_symmetric(tube.patch, *tube.mirror);
  if (is_polished) polish(tube.patch, wanted.project);
  if (tube.mirror) make_symmetric(tube.patch, *tube.mirror);  // but for rounding it is
  return improve_and_offer(tube, {FaceGoal::All, FaceGoal::Worst}, wanted, choice);
}

// The best tube once more where it is not good: what told it from others need not be where its faces are
// best.
void settle(const WantedSurface& surface, Choice& choice) {
  if (!choice.best() || choice.is_good()) return;
  LaidTube tube = *choice.best();
  improve_and_offer(tube, {FaceGoal::Settled, FaceGoal::Worst}, wanted_for(tube, surface), choice);
}

// Tables tried among seams once one has passed: more gained 0.03 in least scaled Jacobian and took a second
// (ours).
constexpr int kMoreAmongSeams = 2;

void try_tables(const QuadTube& tube, const Maker& maker, const TubeProblem& problem, std::size_t borders,
                Choice& choice) {
  std::vector<std::pair<int, TubeTable>> tried;
  int since_best = 0;
  for (const TubeOptions& options : options_for(borders))
    for (const int more : kMoreRows) {
      const int rows = tube.wanted_rows() + more;
      const auto table = maker.table(rows, options);
      if (!table || std::find(tried.begin(), tried.end(), std::pair(rows, *table)) != tried.end()) continue;
      double least = -1;
      if (const auto laid = maker.laid(*table, rows))
        for (const bool is_polished : {true, false}) {
          least = std::max(least, offer_places(*laid, problem.surface, is_polished, choice));
          if (choice.is_good()) return;
        }
      if (tried.empty() && least < kHopeless) return;
      if (borders > 2 && choice.best() && since_best++ == kMoreAmongSeams) return;
      tried.emplace_back(rows, *table);
    }
}

void try_domain(const TubeDomain& domain, const std::function<Maker(const QuadTube&)>& maker,
                const TubeProblem& problem, std::size_t borders, Choice& choice) {
  std::string trouble;
  if (const auto tube = QuadTube::make(domain, trouble))
    try_tables(*tube, maker(*tube), problem, borders, choice);
  else
    choice.note(trouble);
}

}  // namespace

std::optional<QuadPatch> best_tube(const TrianglePatch& patch, const TubeProblem& problem, std::string& fault,
                                   const PatchMirror* mirror) {
  Choice choice(problem);
  const TrianglePatch fine = remesh(patch, problem.surface.project, {.length_scale = kDomainScale});
  const std::size_t borders = problem.loops.size();
  if (mirror && borders > 2) {
    // Halves differ in the counts on the plane, and those matter.
    for (const TubeDomain& domain : half_domains(fine, problem.loops, *mirror)) {
      const auto maker = [&](const QuadTube& tube) {
        return unfolded_tube(tube, domain.seams.size(), *mirror);
      };
      if (!choice.is_good()) try_domain(domain, maker, problem, 2, choice);
    }
  } else {
    const auto maker = [&](const QuadTube& tube) {
      return mirror ? symmetric_tube(tube, *mirror) : any_tube(tube);
    };
    if (const auto domain = tube_domain(fine, problem.loops))
      try_domain(*domain, maker, problem, borders, choice);
    if (!choice.best())
      if (const auto domain = even_domain(fine, problem.loops))
        try_domain(*domain, maker, problem, borders, choice);
  }
  settle(problem.surface, choice);
  if (choice.best()) return choice.best()->patch;
  fault = choice.fault().empty() ? "the counts of its borders do not meet" : choice.fault();
  return std::nullopt;
}

}  // namespace skinforge
