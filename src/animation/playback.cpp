#include "animation/playback.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace skinforge {
namespace {

constexpr int kTempoPasses = 24;                // ours: (1 2 1) / 4 so often spreads a skip over +-3.5 frames
constexpr int kLimitPasses = 400;               // ours: a chain of 100 keys settles within a few dozen
constexpr double kFullTurn = std::numbers::pi;  // no two rotations are farther apart
constexpr double kDotRounding = 1e-12;          // a few roundings of a unit quaternion
constexpr double kShrink = 0.05;                // ours: any share ends the last resort
constexpr double kBelowLimit = 0.999;           // ours: leaves room for rounding to float

// A stretch without jumps: where in its clip each of its frames lies.
struct Stretch {
  std::size_t begin = 0;  // first frame of the path
  std::size_t clip = 0;
  std::vector<double> steps;   // from each frame to the one before it; the first is the speed it starts with
  std::vector<double> frames;  // per frame of the stretch
};

double advance(PathStep step) {
  if (step == PathStep::Hold) return 0;
  return step == PathStep::Skip ? 2 : 1;
}

std::size_t clip_of(const MotionSet& set, std::int32_t frame) {
  const auto after = std::upper_bound(set.clip_begin.begin(), set.clip_begin.end(), frame);
  return static_cast<std::size_t>(after - set.clip_begin.begin()) - 1;
}

// Repeated means of neighbours; the sum stays. In a ring the ends are neighbours, else they see themselves.
void smooth(std::span<double> values, bool is_ring) {
  const std::size_t n = values.size();
  std::vector<double> old(n);
  for (int pass = 0; n > 1 && pass < kTempoPasses; ++pass) {
    std::copy(values.begin(), values.end(), old.begin());
    for (std::size_t k = 0; k < n; ++k) {
      const double before = k > 0 ? old[k - 1] : old[is_ring ? n - 1 : 0];
      const double after = k + 1 < n ? old[k + 1] : old[is_ring ? 0 : n - 1];
      values[k] = (before + 2 * old[k] + after) / 4;
    }
  }
}

Stretch make_stretch(const KeyframePath& path, const MotionSet& set, std::size_t begin, std::size_t length,
                     bool is_ring) {
  const std::size_t n = path.candidates.size();
  const std::int32_t first = path.candidates[begin];
  Stretch stretch{begin, clip_of(set, first), {}, {}};
  for (std::size_t k = 0; k < length; ++k)
    stretch.steps.push_back(k == 0 && !is_ring ? 1 : advance(path.steps[(begin + k) % n]));
  smooth(is_ring ? std::span(stretch.steps) : std::span(stretch.steps).subspan(1), is_ring);
  if (!is_ring && length > 1) stretch.steps[0] = stretch.steps[1];
  double frame = first - set.clip_begin[stretch.clip];
  for (std::size_t k = 0; k < length; ++k) {
    if (k > 0) frame += stretch.steps[k];
    stretch.frames.push_back(frame);
  }
  return stretch;
}

std::vector<Stretch> stretches_of(const KeyframePath& path, const MotionSet& set, bool is_loop) {
  const std::size_t n = path.candidates.size();
  std::vector<std::size_t> starts;
  for (std::size_t f = 0; f < n; ++f)
    if (path.steps[f] == PathStep::Jump || (f == 0 && !is_loop)) starts.push_back(f);
  if (starts.empty()) return {make_stretch(path, set, 0, n, true)};
  std::vector<Stretch> stretches;
  for (std::size_t k = 0; k < starts.size(); ++k) {
    const std::size_t end = k + 1 < starts.size() ? starts[k + 1] : (is_loop ? starts[0] + n : n);
    stretches.push_back(make_stretch(path, set, starts[k], end - starts[k], false));
  }
  return stretches;
}

// Place at an offset from the stretch's first frame; beyond its ends it goes on with its speed there.
ClipPosition at_offset(const Stretch& stretch, double offset) {
  const double last = static_cast<double>(stretch.frames.size() - 1);
  if (offset < 0) return {stretch.clip, stretch.frames.front() + offset * stretch.steps.front()};
  if (offset > last) return {stretch.clip, stretch.frames.back() + (offset - last) * stretch.steps.back()};
  return {stretch.clip, stretch.frames[static_cast<std::size_t>(offset)]};
}

double smooth_step(double x) {
  return x * x * (3 - 2 * x);
}

void crossfade(const Stretch& before, const Stretch& after, std::size_t half_fade,
               std::vector<PlaybackFrame>& frames) {
  const std::size_t half = std::min({half_fade, before.frames.size() / 2, after.frames.size() / 2});
  const std::size_t n = frames.size();
  for (std::size_t k = 0; k < 2 * half; ++k) {
    const double offset =
        static_cast<double>(k) - static_cast<double>(half);  // from the first frame of `after`
    const double share = (offset + 0.5 + static_cast<double>(half)) / (2 * static_cast<double>(half));
    frames[(after.begin + n + k - half) % n] = {
        at_offset(before, static_cast<double>(before.frames.size()) + offset), at_offset(after, offset),
        smooth_step(share)};
  }
}

// Moves both rotations towards each other until they are `limit` apart; false when they already are.
bool pull_together(Quat& a, Quat& b, double limit, double limit_dot) {
  if (std::abs(a.dot(b)) > limit_dot) return false;  // most: no need for the angle
  const double angle = a.angularDistance(b);
  if (angle <= limit) return false;
  const double share = 0.5 * (1 - kBelowLimit * limit / angle);
  const Quat from = a;
  a = from.slerp(share, b).normalized();
  b = b.slerp(share, from).normalized();
  return true;
}

}  // namespace

Transform blend(const Transform& a, const Transform& b, double share) {
  if (share == 0) return a;
  return {(1 - share) * a.translation + share * b.translation, a.rotation.slerp(share, b.rotation),
          (1 - share) * a.scale + share * b.scale};
}

std::vector<PlaybackFrame> play(const KeyframePath& path, const MotionSet& set, bool is_loop,
                                std::size_t half_fade) {
  const std::size_t n = path.candidates.size();
  const std::vector<Stretch> stretches = stretches_of(path, set, is_loop);
  std::vector<PlaybackFrame> frames(n);
  for (const Stretch& stretch : stretches)
    for (std::size_t k = 0; k < stretch.frames.size(); ++k) {
      const ClipPosition position = at_offset(stretch, static_cast<double>(k));
      frames[(stretch.begin + k) % n] = {position, position, 0};
    }
  const bool seamless = stretches.size() == 1 && path.steps[stretches[0].begin] != PathStep::Jump;
  if (seamless) return frames;
  for (std::size_t k = is_loop ? 0 : 1; k < stretches.size(); ++k)
    crossfade(stretches[(k + stretches.size() - 1) % stretches.size()], stretches[k], half_fade, frames);
  return frames;
}

void limit_turns(std::vector<Quat>& rotations, double limit, bool is_loop) {
  const std::size_t n = rotations.size();
  if (n < 2) return;
  const double limit_dot = std::cos(std::min(limit, kFullTurn) / 2) + kDotRounding;
  const std::size_t pairs = is_loop ? n : n - 1;  // of a key and the next
  std::vector<std::uint8_t> is_open(n, 1);        // pairs of which a key was moved since they were looked at
  const auto pull_all = [&] {
    bool moved = false;
    for (std::size_t k = 0; k < pairs; ++k) {
      if (!is_open[k]) continue;
      is_open[k] = 0;
      if (!pull_together(rotations[k], rotations[(k + 1) % n], limit, limit_dot)) continue;
      is_open[(k + n - 1) % n] = is_open[k] = is_open[(k + 1) % n] = 1;
      moved = true;
    }
    return moved;
  };
  for (int pass = 0; pass < kLimitPasses; ++pass)
    if (!pull_all()) return;
  // It will not settle (a limit near zero): bring all keys nearer to the first, which ends with them equal.
  const Quat first = rotations[0];
  for (int pass = 0; pass < kLimitPasses && pull_all(); ++pass) {
    for (Quat& q : rotations) q = q.slerp(kShrink, first).normalized();
    std::fill(is_open.begin(), is_open.end(), 1);
  }
  if (pull_all()) std::fill(rotations.begin(), rotations.end(), first);
}

}  // namespace skinforge
