#include "animation/limbs.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

namespace skinforge {
namespace {

constexpr double kSameLimb = 0.5;        // ours: share of names
constexpr double kStepSeconds = 0.4;     // ours: of a movement that is no gait
constexpr double kComesAgain = 0.1;      // ours: of the largest distance between two poses of the clip
constexpr double kRampPerDelay = 4;      // ours: tempo 1 +- 1.5 / 4
constexpr double kDelayPerLength = 0.1;  // ours: of short clips

std::set<std::string> kept_names(const Character& character, const GraftSource& source) {
  std::set<std::string> names;
  for (std::size_t j = 0; j < source.result_joint.size(); ++j)
    if (source.result_joint[j].is_valid()) names.insert(character.skeleton.joints[j].name);
  return names;
}

bool is_like(const std::set<std::string>& names, const std::set<std::string>& earlier) {
  const auto common = std::count_if(names.begin(), names.end(),
                                    [&](const std::string& name) { return earlier.contains(name); });
  return static_cast<double>(common) > kSameLimb * static_cast<double>(names.size());
}

// Mean of 1 - |q . q'| over the joints.
double pose_distance(const Pose& a, const Pose& b) {
  double sum = 0;
  for (std::size_t j = 0; j < a.size(); ++j) sum += 1 - std::abs(a[j].rotation.dot(b[j].rotation));
  return a.empty() ? 0 : sum / static_cast<double>(a.size());
}

double smooth_ramp(double x) {
  x = std::clamp(x, 0.0, 1.0);
  return x * x * (3 - 2 * x);
}

}  // namespace

std::vector<LimbRank> limb_ranks(std::span<const Character* const> characters, const Graft& graft) {
  std::vector<std::set<std::string>> names;
  std::vector<LimbRank> ranks;
  for (const GraftSource& source : graft.sources) {
    names.push_back(kept_names(*characters[source.input], source));
    LimbRank rank{ranks.size(), 0, 1};
    for (std::size_t s = 0; s < ranks.size(); ++s)
      if (is_like(names.back(), names[s])) rank = {ranks[s].family, ranks[s].rank + 1, 1};
    ranks.push_back(rank);
  }
  for (LimbRank& rank : ranks)
    for (const LimbRank& other : ranks)
      if (other.family == rank.family) rank.count = std::max(rank.count, other.rank + 1);
  return ranks;
}

double steps_behind(const LimbRank& part, const LimbRank& driver, const std::optional<double>& limb_phase) {
  if (part.family != driver.family) return 0;
  const double ranks = static_cast<double>(part.rank) - static_cast<double>(driver.rank);
  return ranks * limb_phase.value_or(1.0 / static_cast<double>(part.count));
}

double step_frames(const MotionSet& set, std::size_t clip, bool is_loop) {
  if (!is_loop) return kStepSeconds * kSearchRate;
  const auto first = static_cast<std::size_t>(set.clip_begin[clip]);
  const auto frames = static_cast<std::size_t>(set.clip_begin[clip + 1]) - first - 1;
  std::vector<double> after;  // mean distance between poses so many frames apart
  for (std::size_t lag = 0; lag < frames; ++lag) {
    double sum = 0;
    for (std::size_t f = 0; f < frames; ++f)
      sum += pose_distance(set.poses[first + f], set.poses[first + (f + lag) % frames]);
    after.push_back(sum / static_cast<double>(frames));
  }
  const double largest = after.empty() ? 0 : *std::max_element(after.begin(), after.end());
  std::size_t steps = 1;
  for (std::size_t count = 2; 4 * count <= frames; ++count)
    if (after[(frames + count / 2) / count] <= kComesAgain * largest) steps = count;
  return static_cast<double>(frames) / static_cast<double>(steps);
}

double delayed_frame(double frame, double delay, double last, bool is_loop) {
  if (is_loop || delay == 0) return frame - delay;
  const double wanted = std::clamp(delay, -kDelayPerLength * last, kDelayPerLength * last);
  const double ramp = kRampPerDelay * std::abs(wanted);
  return frame - wanted * smooth_ramp(frame / ramp) * smooth_ramp((last - frame) / ramp);
}

}  // namespace skinforge
