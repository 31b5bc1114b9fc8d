#include "animation/keyframe_path.h"

#include <Eigen/Core>
#include <algorithm>
#include <limits>
#include <numeric>

#include "base/expect.h"

namespace skinforge {
namespace {

constexpr float kNever = std::numeric_limits<float>::infinity();
constexpr std::size_t kJumpOrigins = 24;  // ours: cheapest keyframes that a jump may leave from
constexpr int kPlayedBeforeHold = 10;     // ours: frames; a third of a second at 30 Hz
constexpr std::size_t kBlock = 8;
using Block = Eigen::Array<float, kBlock, 1>;

// One frame of the search: for each candidate the cheapest way to it.
struct Layer {
  std::vector<float> cost;
  std::vector<std::int32_t> from;
  std::vector<PathStep> step;

  explicit Layer(std::size_t n) : cost(n, kNever), from(n, -1), step(n, PathStep::Next) {}
  void offer(std::size_t to, std::size_t origin, PathStep how, float total) {
    if (total >= cost[to]) return;
    cost[to] = total;
    from[to] = static_cast<std::int32_t>(origin);
    step[to] = how;
  }
};

class Search {
 public:
  Search(const DistanceTable& distances, const FrameSteps& steps, const std::vector<bool>& allowed,
         const LandingCosts& landing, const PathCosts& costs, bool may_stay);

  // Path over the given frames (indices into the table); `fixed`: first and last keyframe, or -1 for free
  // ends.
  KeyframePath run(std::span<const std::size_t> frames, std::int32_t fixed) const;

 private:
  Layer first_layer(std::size_t frame, std::int32_t fixed) const;
  Layer next_layer(const Layer& before, std::size_t frame) const;
  void step_on(const Layer& before, std::size_t to, Layer& layer) const;
  void jump_on(const Layer& before, Layer& layer) const;
  void land(std::size_t origin, float base, Layer& layer) const;
  float dearest_of(const Layer& layer) const;

  const DistanceTable& distances_;
  const FrameSteps& steps_;
  const std::vector<bool>& allowed_;
  const LandingCosts& landing_;
  PathCosts costs_;
  bool may_stay_;
  std::vector<bool> may_enter_;  // by a jump, or as the first keyframe
};

Search::Search(const DistanceTable& distances, const FrameSteps& steps, const std::vector<bool>& allowed,
               const LandingCosts& landing, const PathCosts& costs, bool may_stay)
    : distances_(distances),
      steps_(steps),
      allowed_(allowed),
      landing_(landing),
      costs_(costs),
      may_stay_(may_stay),
      may_enter_(allowed) {
  if (!may_stay) return;
  for (std::size_t c = 0; c < allowed.size(); ++c) {
    if (steps.next[c] >= 0) continue;
    auto near_end = static_cast<std::int32_t>(c);
    for (int k = 0; k < kPlayedBeforeHold && near_end >= 0; ++k) {
      may_enter_[static_cast<std::size_t>(near_end)] = false;
      near_end = steps.previous[static_cast<std::size_t>(near_end)];
    }
  }
  if (std::find(may_enter_.begin(), may_enter_.end(), true) == may_enter_.end()) may_enter_ = allowed;
}

Layer Search::first_layer(std::size_t frame, std::int32_t fixed) const {
  Layer layer(distances_.candidates);
  for (std::size_t c = 0; c < distances_.candidates; ++c)
    if (fixed < 0 ? may_enter_[c] : static_cast<std::size_t>(fixed) == c)
      layer.cost[c] = distances_.row(frame)[c];
  return layer;
}

// The ways that follow a clip: natural successor, hold, double speed.
void Search::step_on(const Layer& before, std::size_t to, Layer& layer) const {
  if (steps_.previous[to] >= 0) {
    const auto previous = static_cast<std::size_t>(steps_.previous[to]);
    layer.offer(to, previous, PathStep::Next, before.cost[previous]);
    if (steps_.previous[previous] >= 0) {
      const auto second = static_cast<std::size_t>(steps_.previous[previous]);
      layer.offer(to, second, PathStep::Skip, before.cost[second] + costs_.tempo);
    }
  }
  const bool at_end = may_stay_ && steps_.next[to] < 0;
  if (before.step[to] != PathStep::Hold || at_end)
    layer.offer(to, to, PathStep::Hold, before.cost[to] + costs_.tempo);
}

float Search::dearest_of(const Layer& layer) const {
  float dearest = -kNever;
  for (std::size_t c = 0; c < layer.cost.size(); ++c)
    if (may_enter_[c]) dearest = std::max(dearest, layer.cost[c]);
  return dearest;
}

void Search::land(std::size_t origin, float base, Layer& layer) const {
  const auto landing = landing_(static_cast<std::int32_t>(origin));
  const std::size_t n = layer.cost.size();
  for (std::size_t block = 0; block < n; block += kBlock) {
    if (block + kBlock <= n) {  // most blocks have nothing to gain
      const Block totals = base + Eigen::Map<const Block>(landing.data() + block);
      if (!(totals < Eigen::Map<const Block>(layer.cost.data() + block)).any()) continue;
    }
    for (std::size_t t = block; t < std::min(n, block + kBlock); ++t)
      if (may_enter_[t]) layer.offer(t, origin, PathStep::Jump, base + landing[t]);
  }
}

void Search::jump_on(const Layer& before, Layer& layer) const {
  std::vector<std::size_t> origins(before.cost.size());
  std::iota(origins.begin(), origins.end(), std::size_t{0});
  const std::size_t count = std::min(kJumpOrigins, origins.size());
  std::partial_sort(origins.begin(), origins.begin() + static_cast<std::ptrdiff_t>(count), origins.end(),
                    [&](std::size_t a, std::size_t b) {
                      return before.cost[a] != before.cost[b] ? before.cost[a] < before.cost[b] : a < b;
                    });
  origins.resize(count);
  for (const std::size_t origin : origins) {
    const float base = before.cost[origin] + costs_.jump;
    if (!(base < dearest_of(layer))) break;  // nothing is left to gain from dearer origins
    land(origin, base, layer);
  }
}

Layer Search::next_layer(const Layer& before, std::size_t frame) const {
  Layer layer(distances_.candidates);
  for (std::size_t c = 0; c < distances_.candidates; ++c) {
    if (allowed_[c]) step_on(before, c, layer);
    if (!may_enter_[c] && layer.cost[c] == kNever) layer.cost[c] = -kNever;  // no jump comes here
  }
  jump_on(before, layer);
  const auto row = distances_.row(frame);
  for (std::size_t c = 0; c < distances_.candidates; ++c)
    layer.cost[c] = layer.cost[c] == -kNever ? kNever : layer.cost[c] + row[c];
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
  const Search search(distances, steps, allowed, landing, costs, !is_loop);
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
