#include "animation/keyframe_path.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "base/expect.h"

namespace skinforge {
namespace {

constexpr float kNever = std::numeric_limits<float>::infinity();
constexpr std::size_t kJumpOrigins = 64;  // ours: cheapest keyframes that a jump may leave from

// One frame of the search: for each candidate the cheapest way to it.
struct Layer {
  std::vector<float> cost;
  std::vector<std::int32_t> from;
  std::vector<PathStep> step;
};

class Search {
 public:
  Search(const DistanceTable& distances, const FrameSteps& steps, const std::vector<bool>& allowed,
         const LandingCosts& landing, const PathCosts& costs)
      : distances_(distances), steps_(steps), allowed_(allowed), landing_(landing), costs_(costs) {}

  // Path over the given frames (indices into the table); `fixed`: first and last keyframe, or -1 for free
  // ends.
  KeyframePath run(std::span<const std::size_t> frames, std::int32_t fixed) const;

 private:
  Layer first_layer(std::size_t frame, std::int32_t fixed) const;
  Layer next_layer(const Layer& before, std::size_t frame) const;
  void step_on(const Layer& before, std::int32_t to, Layer& layer) const;
  void jump_on(const Layer& before, Layer& layer) const;
  float dearest_of(const Layer& layer) const;

  const DistanceTable& distances_;
  const FrameSteps& steps_;
  const std::vector<bool>& allowed_;
  const LandingCosts& landing_;
  PathCosts costs_;
};

Layer Search::first_layer(std::size_t frame, std::int32_t fixed) const {
  const std::size_t n = distances_.candidates;
  Layer layer{std::vector<float>(n, kNever), std::vector<std::int32_t>(n, -1),
              std::vector(n, PathStep::Next)};
  for (std::size_t c = 0; c < n; ++c)
    if (allowed_[c] && (fixed < 0 || static_cast<std::size_t>(fixed) == c))
      layer.cost[c] = distances_.row(frame)[c];
  return layer;
}

// The ways that follow a clip: natural successor, hold, double speed.
void Search::step_on(const Layer& before, std::int32_t to, Layer& layer) const {
  const auto t = static_cast<std::size_t>(to);
  const auto offer = [&](std::int32_t from, PathStep step, float cost) {
    const float total = before.cost[static_cast<std::size_t>(from)] + cost;
    if (total >= layer.cost[t]) return;
    layer.cost[t] = total;
    layer.from[t] = from;
    layer.step[t] = step;
  };
  const std::int32_t previous = steps_.previous[t];
  if (previous >= 0) {
    offer(previous, PathStep::Next, 0);
    const std::int32_t second = steps_.previous[static_cast<std::size_t>(previous)];
    if (second >= 0) offer(second, PathStep::Skip, costs_.tempo);
  }
  if (before.step[t] != PathStep::Hold) offer(to, PathStep::Hold, costs_.tempo);
}

float Search::dearest_of(const Layer& layer) const {
  float dearest = -kNever;
  for (std::size_t c = 0; c < layer.cost.size(); ++c)
    if (allowed_[c]) dearest = std::max(dearest, layer.cost[c]);
  return dearest;
}

void Search::jump_on(const Layer& before, Layer& layer) const {
  std::vector<std::int32_t> origins(before.cost.size());
  std::iota(origins.begin(), origins.end(), 0);
  const std::size_t count = std::min(kJumpOrigins, origins.size());
  std::partial_sort(origins.begin(), origins.begin() + static_cast<std::ptrdiff_t>(count), origins.end(),
                    [&](std::int32_t a, std::int32_t b) {
                      const float cost_a = before.cost[static_cast<std::size_t>(a)];
                      const float cost_b = before.cost[static_cast<std::size_t>(b)];
                      return cost_a != cost_b ? cost_a < cost_b : a < b;
                    });
  origins.resize(count);
  for (const std::int32_t from : origins) {
    const auto s = static_cast<std::size_t>(from);
    const float base = before.cost[s] + costs_.jump;
    if (!(base < dearest_of(layer))) break;  // nothing is left to gain from dearer origins
    const std::int32_t expected = steps_.next[s] < 0 ? from : steps_.next[s];
    const auto arrival = landing_(expected), departure = landing_(from);
    for (std::size_t t = 0; t < layer.cost.size(); ++t) {
      if (!allowed_[t] || base >= layer.cost[t]) continue;
      const auto before_landing = static_cast<std::size_t>(
          steps_.previous[t] < 0 ? static_cast<std::int32_t>(t) : steps_.previous[t]);
      const float total = base + costs_.landing * 0.5F * (arrival[t] + departure[before_landing]);
      if (total >= layer.cost[t]) continue;
      layer.cost[t] = total;
      layer.from[t] = from;
      layer.step[t] = PathStep::Jump;
    }
  }
}

Layer Search::next_layer(const Layer& before, std::size_t frame) const {
  const std::size_t n = distances_.candidates;
  Layer layer{std::vector<float>(n, kNever), std::vector<std::int32_t>(n, -1),
              std::vector(n, PathStep::Jump)};
  for (std::size_t c = 0; c < n; ++c)
    if (allowed_[c]) step_on(before, static_cast<std::int32_t>(c), layer);
  jump_on(before, layer);
  for (std::size_t c = 0; c < n; ++c) layer.cost[c] += distances_.row(frame)[c];
  return layer;
}

KeyframePath Search::run(std::span<const std::size_t> frames, std::int32_t fixed) const {
  std::vector<Layer> layers = {first_layer(frames.front(), fixed)};
  for (std::size_t k = 1; k < frames.size(); ++k) layers.push_back(next_layer(layers.back(), frames[k]));
  const std::vector<float>& last = layers.back().cost;
  auto c = fixed >= 0 ? static_cast<std::size_t>(fixed)
                      : static_cast<std::size_t>(std::min_element(last.begin(), last.end()) - last.begin());
  KeyframePath path;
  for (std::size_t k = frames.size(); k-- > 0;) {
    path.candidates.push_back(static_cast<std::int32_t>(c));
    path.steps.push_back(layers[k].step[c]);
    if (k > 0) c = static_cast<std::size_t>(layers[k].from[c]);
  }
  std::reverse(path.candidates.begin(), path.candidates.end());
  std::reverse(path.steps.begin(), path.steps.end());
  return path;
}

}  // namespace

KeyframePath best_path(const DistanceTable& distances, const FrameSteps& steps,
                       const std::vector<bool>& allowed, const LandingCosts& landing, bool is_loop,
                       const PathCosts& costs) {
  SF_EXPECT(std::find(allowed.begin(), allowed.end(), true) != allowed.end());
  const Search search(distances, steps, allowed, landing, costs);
  std::vector<std::size_t> lap(distances.frames);
  std::iota(lap.begin(), lap.end(), std::size_t{0});
  if (!is_loop) return search.run(lap, -1);

  std::vector<std::size_t> two_laps = lap;
  two_laps.insert(two_laps.end(), lap.begin(), lap.end());
  const std::int32_t middle = search.run(two_laps, -1).candidates[distances.frames];
  lap.push_back(0);
  KeyframePath path = search.run(lap, middle);
  path.steps.front() = path.steps.back();
  path.steps.pop_back();
  path.candidates.pop_back();
  return path;
}

KeyframePath best_frames(const DistanceTable& distances, const FrameSteps& steps,
                         const std::vector<bool>& allowed) {
  KeyframePath path;
  for (std::size_t f = 0; f < distances.frames; ++f) {
    const auto row = distances.row(f);
    std::int32_t best = -1;
    for (std::size_t c = 0; c < row.size(); ++c)
      if (allowed[c] && (best < 0 || row[c] < row[static_cast<std::size_t>(best)]))
        best = static_cast<std::int32_t>(c);
    const std::int32_t last = path.candidates.empty() ? -1 : path.candidates.back();
    const bool follows = last < 0 || steps.next[static_cast<std::size_t>(last)] == best;
    path.candidates.push_back(best);
    path.steps.push_back(follows ? PathStep::Next : PathStep::Jump);
  }
  return path;
}

}  // namespace skinforge
