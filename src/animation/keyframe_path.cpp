#include "animation/keyframe_path.h"

#include <Eigen/Core>
#include <algorithm>
#include <limits>
#include <utility>

#include "base/expect.h"

namespace skinforge {
namespace {

constexpr float kNever = std::numeric_limits<float>::infinity();
constexpr std::size_t kJumpOrigins = 12;  // ours: cheapest keyframes that a jump may leave from
constexpr int kPlayedBeforeHold = 10;     // ours: frames; a third of a second at 30 Hz
constexpr std::size_t kFreeFrames = 60;   // ours: a free search of two seconds forgets its ends
constexpr std::size_t kBlock = 8;         // two vector registers

// One frame of the search: for each candidate the cheapest way to it. One slot more, never reached, stands
// for "none".
struct Layer {
  std::vector<float> cost;
  std::vector<PathStep> step;
  std::vector<std::int32_t> origin;  // of a Jump

  explicit Layer(std::size_t n) : cost(n + 1, kNever), step(n + 1, PathStep::Next), origin(n + 1, -1) {}
};

class Search {
 public:
  Search(const DistanceTable& distances, const FrameSteps& steps, const std::vector<bool>& allowed,
         const LandingCosts& landing, const PathCosts& costs, bool may_stay);

  // Path over the given frames (indices into the table); `fixed`: first and last keyframe, or -1 for free
  // ends.
  KeyframePath run(std::span<const std::size_t> frames, std::int32_t fixed) const;

 private:
  void find_entries(const FrameSteps& steps, bool may_stay);
  Layer first_layer(std::size_t frame, std::int32_t fixed) const;
  Layer next_layer(const Layer& before, std::size_t frame) const;
  void step_on(const Layer& before, Layer& layer) const;
  void jump_on(const Layer& before, Layer& layer) const;
  void land(std::size_t origin, float base, std::span<float> to_beat, Layer& layer) const;
  std::size_t before(std::size_t candidate, const Layer& layer) const;

  const DistanceTable& distances_;
  const LandingCosts& landing_;
  PathCosts costs_;
  std::size_t n_;
  std::vector<std::uint8_t> allowed_;
  std::vector<std::uint8_t> may_enter_;       // by a jump, or as the first keyframe
  std::vector<std::uint8_t> may_stay_;        // ends of clips, where a Hold may follow a Hold
  std::vector<std::size_t> before_, second_;  // one and two natural steps back, or n_
};

Search::Search(const DistanceTable& distances, const FrameSteps& steps, const std::vector<bool>& allowed,
               const LandingCosts& landing, const PathCosts& costs, bool may_stay)
    : distances_(distances),
      landing_(landing),
      costs_(costs),
      n_(distances.candidates),
      allowed_(allowed.begin(), allowed.end()),
      may_enter_(allowed_),
      may_stay_(n_, 0) {
  for (const std::int32_t previous : steps.previous)
    before_.push_back(previous < 0 ? n_ : static_cast<std::size_t>(previous));
  for (const std::size_t previous : before_) second_.push_back(previous == n_ ? n_ : before_[previous]);
  find_entries(steps, may_stay);
}

// The last frames of a clip that ends may only be reached by playing.
void Search::find_entries(const FrameSteps& steps, bool may_stay) {
  for (std::size_t c = 0; may_stay && c < n_; ++c) {
    if (steps.next[c] >= 0) continue;
    may_stay_[c] = 1;
    std::size_t near_end = c;
    for (int k = 0; k < kPlayedBeforeHold && near_end != n_; ++k, near_end = before_[near_end])
      may_enter_[near_end] = 0;
  }
  if (std::find(may_enter_.begin(), may_enter_.end(), 1) == may_enter_.end()) may_enter_ = allowed_;
}

Layer Search::first_layer(std::size_t frame, std::int32_t fixed) const {
  Layer layer(n_);
  for (std::size_t c = 0; c < n_; ++c)
    if (fixed < 0 ? may_enter_[c] : static_cast<std::size_t>(fixed) == c)
      layer.cost[c] = distances_.row(frame)[c];
  return layer;
}

// The ways that follow a clip: natural successor, hold, double speed.
void Search::step_on(const Layer& before, Layer& layer) const {
  for (std::size_t c = 0; c < n_; ++c) {
    if (!allowed_[c]) continue;
    float best = before.cost[before_[c]];
    PathStep step = PathStep::Next;
    const float skip = before.cost[second_[c]] + costs_.tempo;
    step = skip < best ? PathStep::Skip : step;
    best = std::min(best, skip);
    const bool may_hold = before.step[c] != PathStep::Hold || may_stay_[c];
    const float hold = may_hold ? before.cost[c] + costs_.tempo : kNever;
    layer.step[c] = hold < best ? PathStep::Hold : step;
    layer.cost[c] = std::min(best, hold);
  }
}

struct Origin {
  float cost;
  std::size_t candidate;
};

// Candidates below a limit from which to jump: the cheapest few, cheapest first, of equals the first.
std::vector<Origin> cheapest(std::span<const float> costs, float limit) {
  std::vector<Origin> best;
  for (std::size_t c = 0; c < costs.size(); ++c) {
    if (!(costs[c] < limit)) continue;
    if (best.size() == kJumpOrigins) best.pop_back();
    const auto place = std::upper_bound(best.begin(), best.end(), costs[c],
                                        [](float cost, const Origin& origin) { return cost < origin.cost; });
    best.insert(place, {costs[c], c});
    if (best.size() == kJumpOrigins) limit = best.back().cost;
  }
  return best;
}

// Whether a block of landings might be cheaper than what there is; most are not.
bool may_gain(const float* to_beat, const float* landing, float base) {
  using Half = Eigen::Map<const Eigen::Array4f>;
  const Eigen::Array4f first = Half(to_beat) - Half(landing), second = Half(to_beat + 4) - Half(landing + 4);
  return first.max(second).maxCoeff() > base;
}

// `to_beat`: the cost of each candidate that may be entered, below all costs for the others.
void Search::land(std::size_t origin, float base, std::span<float> to_beat, Layer& layer) const {
  const auto landing = landing_(static_cast<std::int32_t>(origin));
  for (std::size_t block = 0; block < n_; block += kBlock) {
    const bool whole = block + kBlock <= n_;
    if (whole && !may_gain(to_beat.data() + block, landing.data() + block, base)) continue;
    for (std::size_t t = block; t < std::min(n_, block + kBlock); ++t) {
      const float total = base + landing[t];
      if (total >= to_beat[t]) continue;
      to_beat[t] = layer.cost[t] = total;
      layer.step[t] = PathStep::Jump;
      layer.origin[t] = static_cast<std::int32_t>(origin);
    }
  }
}

void Search::jump_on(const Layer& before, Layer& layer) const {
  std::vector<float> to_beat(n_, -kNever);
  for (std::size_t c = 0; c < n_; ++c)
    if (may_enter_[c]) to_beat[c] = layer.cost[c];
  const float dearest = *std::max_element(to_beat.begin(), to_beat.end());
  for (const Origin& origin : cheapest(before.cost, dearest - costs_.jump))
    land(origin.candidate, origin.cost + costs_.jump, to_beat, layer);
}

Layer Search::next_layer(const Layer& before, std::size_t frame) const {
  Layer layer(n_);
  step_on(before, layer);
  jump_on(before, layer);
  const auto row = distances_.row(frame);
  for (std::size_t c = 0; c < n_; ++c) layer.cost[c] += row[c];
  return layer;
}

std::size_t Search::before(std::size_t candidate, const Layer& layer) const {
  switch (layer.step[candidate]) {
    case PathStep::Next:
      return before_[candidate];
    case PathStep::Skip:
      return second_[candidate];
    case PathStep::Hold:
      return candidate;
    case PathStep::Jump:
      return static_cast<std::size_t>(layer.origin[candidate]);
  }
  return candidate;
}

KeyframePath Search::run(std::span<const std::size_t> frames, std::int32_t fixed) const {
  std::vector<Layer> layers = {first_layer(frames.front(), fixed)};
  for (std::size_t k = 1; k < frames.size(); ++k) layers.push_back(next_layer(layers.back(), frames[k]));
  const std::vector<float>& last = layers.back().cost;
  auto c = fixed >= 0 ? static_cast<std::size_t>(fixed)
                      : static_cast<std::size_t>(std::min_element(last.begin(), last.end()) - last.begin());
  SF_EXPECT(last[c] < kNever);
  KeyframePath path;
  for (std::size_t k = frames.size(); k-- > 0;) {
    path.candidates.push_back(static_cast<std::int32_t>(c));
    path.steps.push_back(layers[k].step[c]);
    if (k > 0) c = before(c, layers[k]);
  }
  std::reverse(path.candidates.begin(), path.candidates.end());
  std::reverse(path.steps.begin(), path.steps.end());
  return path;
}

// Frames of a lap that starts at `start`, `count` of them.
std::vector<std::size_t> lap(std::size_t frames, std::size_t start, std::size_t count) {
  std::vector<std::size_t> all;
  for (std::size_t k = 0; k < count; ++k) all.push_back((start + k) % frames);
  return all;
}

// Free search first, then one lap from the keyframe found in its middle back to itself.
KeyframePath closed_path(const Search& search, std::size_t frames) {
  const std::size_t free_count = std::max(frames, std::min(2 * frames, kFreeFrames));
  const std::size_t middle = free_count / 2;
  const KeyframePath free = search.run(lap(frames, 0, free_count), -1);
  const KeyframePath closed = search.run(lap(frames, middle, frames + 1), free.candidates[middle]);
  KeyframePath path{std::vector<std::int32_t>(frames), std::vector<PathStep>(frames)};
  for (std::size_t k = 1; k <= frames; ++k) {
    path.candidates[(middle + k) % frames] = closed.candidates[k];
    path.steps[(middle + k) % frames] = closed.steps[k];
  }
  return path;
}

}  // namespace

KeyframePath best_path(const DistanceTable& distances, const FrameSteps& steps,
                       const std::vector<bool>& allowed, const LandingCosts& landing, bool is_loop,
                       const PathCosts& costs) {
  SF_EXPECT(std::find(allowed.begin(), allowed.end(), true) != allowed.end());
  const Search search(distances, steps, allowed, landing, costs, !is_loop);
  return is_loop ? closed_path(search, distances.frames)
                 : search.run(lap(distances.frames, 0, distances.frames), -1);
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
