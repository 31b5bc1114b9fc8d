#include "skeleton/joint_similarity.h"

#include <algorithm>
#include <cmath>

namespace skinforge {
namespace {
constexpr double kGeometricWeight = 0.3, kTopologicalWeight = 0.3;  // Sec. 5.1, empirical there
constexpr double kParametricWeight = 0.3, kValenceWeight = 0.1;

// Cosine of the angle between two directions, cut to [0, 1]; none if either has no length.
std::optional<double> direction_similarity(const std::optional<Vec3>& a, const std::optional<Vec3>& b) {
  if (!a || !b) return std::nullopt;
  return std::clamp(a->dot(*b), 0.0, 1.0);
}

double mean_of_defined(std::optional<double> a, std::optional<double> b) {
  if (a && b) return (*a + *b) / 2;
  return a.value_or(b.value_or(0.0));
}
}  // namespace

double JointSimilarity::score() const {
  return kGeometricWeight * geometric + kTopologicalWeight * topological + kParametricWeight * parametric +
         kValenceWeight * valence;
}

JointSimilarity joint_similarity(const SkeletonShape& source, const SkeletonShape& result,
                                 const MapStep& step, JointId candidate) {
  const auto local = direction_similarity(source.direction(step.mapped, step.joint),
                                          result.direction(step.image, candidate));
  const auto global = direction_similarity(source.direction(source.root(), step.joint),
                                           result.direction(result.root(), candidate));
  const int hops = candidate == step.image ? 2 : result.hops(candidate, step.image);  // k in b)
  const auto [fewer, more] = std::minmax({source.valence(step.joint), result.valence(candidate)});

  JointSimilarity s;
  s.geometric = mean_of_defined(local, global);
  s.topological = 1.0 / hops;
  s.parametric = 1.0 - std::abs(source.parametric(step.joint) - result.parametric(candidate));
  s.valence = more == 0 ? 1.0 : static_cast<double>(fewer) / more;  // two lone joints are alike
  return s;
}

}  // namespace skinforge
