#include "animation/key_rate.h"

#include <algorithm>
#include <cmath>

namespace skinforge {
namespace {

constexpr double kSlowest = 10, kFastest = 120;  // ours: keys a second
constexpr double kSameStep = 0.01;      // ours: times are floats, some exporters round to milliseconds
constexpr double kShareOfSteps = 0.9;   // ours: a clip may begin or end with a longer one
constexpr std::size_t kFewestKeys = 4;  // ours: less tell nothing

const std::vector<double>& times_of_most_keys(const Clip& clip) {
  static const std::vector<double> none;
  const std::vector<double>* most = &none;
  const auto consider = [&](const std::vector<double>& times) {
    if (times.size() > most->size()) most = &times;
  };
  for (const JointTracks& tracks : clip.joints) {
    consider(tracks.rotation.times);
    consider(tracks.translation.times);
    consider(tracks.scale.times);
  }
  return *most;
}

}  // namespace

std::optional<double> own_key_rate(const Clip& clip) {
  const std::vector<double>& times = times_of_most_keys(clip);
  if (times.size() < kFewestKeys) return std::nullopt;
  std::vector<double> steps;
  for (std::size_t k = 1; k < times.size(); ++k) steps.push_back(times[k] - times[k - 1]);
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  const double step = *middle;
  const auto alike = std::count_if(steps.begin(), steps.end(),
                                   [&](double s) { return std::abs(s - step) <= kSameStep * step; });
  if (static_cast<double>(alike) < kShareOfSteps * static_cast<double>(steps.size())) return std::nullopt;
  if (step * kFastest < 1 - kSameStep || step * kSlowest > 1 + kSameStep) return std::nullopt;
  return 1 / step;
}

double fastest_keyed_turn(const Clip& clip) {
  double fastest = 0;
  for (const JointTracks& tracks : clip.joints) {
    const QuatTrack& track = tracks.rotation;
    if (track.interpolation != Interpolation::Linear) continue;
    for (std::size_t k = 1; k < track.times.size(); ++k) {
      const double step = track.times[k] - track.times[k - 1];
      if (step * kFastest >= 1 - kSameStep)
        fastest = std::max(fastest, track.values[k - 1].angularDistance(track.values[k]) / step);
    }
  }
  return fastest;
}

}  // namespace skinforge
