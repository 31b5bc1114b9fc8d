#include "animation/keyframe_path.h"

#include <Eigen/Core>
#include <algorithm>
#include <limits>
#include <utility>

#include "animation/lanes.h"
#include "base/expect.h"

namespace skinforge {
namespace {

constexpr float kNever = std::numeric_limits<float>::infinity();
constexpr std::size_t kJumpOrigins = 12;  // ours: cheapest keyframes that a jump may leave from
constexpr int kPlayedBeforeHold = 10;     // ours: frames; a third of a second at 30 Hz
constexpr std::size_t kFreeFrames = 60;   // ours: a free search of two seconds forgets its ends
constexpr std::size_t kBlock = Lanes::kCount;

// Per candidate, behind kMargin entries that are never reached, so that steps back may look before the first.
constexpr std::size_t kMargin = kBlock;
using Row = std::vector<float>;

// What the search knows about one frame.
struct Front {
  Row cost;       // of the cheapest way to each candidate
  Row hold_cost;  // of staying there for another frame; kNever where that would be a second hold
  std::vector<std::uint8_t> since_hold, since_skip;  // frames, only where the tempo has limits of its own
};

// The cheapest way to each candidate in one frame, in a byte each, because long clips need many of them: a
// PathStep, or kJump + k for a jump from the k-th origin.
constexpr std::uint8_t kJump = static_cast<std::uint8_t>(PathStep::Jump);
struct Ways {
  std::vector<std::uint8_t> way;
  std::vector<std::int32_t> origins;  // of the jumps, at most kJumpOrigins

  PathStep step(std::size_t c) const { return static_cast<PathStep>(std::min(way[c], kJump)); }
  std::int32_t origin(std::size_t c) const { return origins[static_cast<std::size_t>(way[c] - kJump)]; }
};

std::size_t padded(std::size_t count) {
  return (count + kBlock - 1) / kBlock * kBlock;
}

// What jumps have to beat: per candidate its cost, below all costs where none may enter; and the largest of
// each block, or more, since costs fall while jumps are tried.
struct ToBeat {
  Row cost, dearest;
  std::vector<std::uint32_t> blocks;  // room for those in which a jump may gain
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
  Front first_front(std::size_t frame, std::int32_t fixed) const;
  Ways go_on(const Front& before, std::size_t frame, ToBeat& to_beat, Front& front) const;
  void step_on(const Front& before, Front& front, Ways& ways) const;
  void step_over_gaps(const Front& before, Front& front, Ways& ways) const;
  void step_within_limits(const Front& before, Front& front, Ways& ways) const;
  bool has_limits() const { return costs_.hold_wait != 1 || costs_.skip_wait != 0; }
  void jump_on(const Front& before, ToBeat& to_beat, Front& front, Ways& ways) const;
  const Row& nearest_landings(std::size_t origin) const;
  void land(std::size_t origin, float base, ToBeat& to_beat, Front& front, Ways& ways) const;
  void pay(std::size_t frame, const Ways& ways, Front& front) const;
  std::size_t before(std::size_t candidate, const Ways& ways) const;

  const DistanceTable& distances_;
  const LandingCosts& landing_;
  PathCosts costs_;
  std::size_t n_;
  std::vector<std::uint8_t> allowed_;
  std::vector<std::uint8_t> may_enter_;        // by a jump, or as the first keyframe
  std::vector<std::uint8_t> may_stay_;         // ends of clips, where a Hold may follow a Hold
  std::vector<std::size_t> before_, second_;   // one and two natural steps back, or n_
  std::vector<std::size_t> gaps_;              // where those are not simply c - 1 and c - 2
  std::size_t padded_;                         // n_, rounded up to whole blocks
  mutable std::vector<Row> nearest_landings_;  // per candidate, once asked for: the least of each block
  std::vector<float> entry_;                   // kNever where a jump may enter, else -kNever
};

Search::Search(const DistanceTable& distances, const FrameSteps& steps, const std::vector<bool>& allowed,
               const LandingCosts& landing, const PathCosts& costs, bool may_stay)
    : distances_(distances),
      landing_(landing),
      costs_(costs),
      n_(distances.candidates),
      allowed_(allowed.begin(), allowed.end()),
      may_enter_(allowed_),
      may_stay_(n_, 0),
      padded_(padded(n_)),
      nearest_landings_(n_) {
  for (const std::int32_t previous : steps.previous)
    before_.push_back(previous < 0 ? n_ : static_cast<std::size_t>(previous));
  for (const std::size_t previous : before_) second_.push_back(previous == n_ ? n_ : before_[previous]);
  for (std::size_t c = 0; c < n_; ++c)
    if (before_[c] + 1 != c || second_[c] + 2 != c) gaps_.push_back(c);
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
  entry_.assign(padded_, -kNever);
  for (std::size_t c = 0; c < n_; ++c)
    if (may_enter_[c]) entry_[c] = kNever;
}

Front Search::first_front(std::size_t frame, std::int32_t fixed) const {
  Front front{Row(kMargin + padded_, kNever), Row(kMargin + padded_, kNever), {}, {}};
  if (has_limits())
    front.since_hold = front.since_skip = std::vector<std::uint8_t>(n_, PathCosts::kNever - 1);
  for (std::size_t c = 0; c < n_; ++c)
    if (fixed < 0 ? may_enter_[c] : static_cast<std::size_t>(fixed) == c) {
      front.cost[kMargin + c] = distances_.row(frame)[c];
      front.hold_cost[kMargin + c] = front.cost[kMargin + c] + costs_.tempo;
    }
  return front;
}

constexpr auto kNext = static_cast<std::uint8_t>(PathStep::Next);
constexpr auto kHold = static_cast<std::uint8_t>(PathStep::Hold);
constexpr auto kSkip = static_cast<std::uint8_t>(PathStep::Skip);

// The cheapest of natural successor, hold and double speed, `from` the first candidate of a block.
SKINFORGE_VECTOR_CLONES void step_blocks(const float* before, const float* hold_cost, float tempo,
                                         std::size_t count, float* cost, std::uint8_t* way) {
  for (std::size_t c = 0; c < count; c += kBlock) {
    const Lanes next = Lanes::load(before + c - 1), skip = Lanes::load(before + c - 2) + tempo,
                hold = Lanes::load(hold_cost + c);
    const Lanes moved = min(next, skip);
    min(moved, hold).store(cost + c);
    const auto skips = skip.v < next.v, holds = hold.v < moved.v;
    for (std::size_t k = 0; k < kBlock; ++k) way[c + k] = holds[k] ? kHold : (skips[k] ? kSkip : kNext);
  }
}

// The ways that follow a clip: natural successor, hold, double speed.
void Search::step_on(const Front& before, Front& front, Ways& ways) const {
  if (has_limits()) {
    step_within_limits(before, front, ways);
  } else {
    step_blocks(before.cost.data() + kMargin, before.hold_cost.data() + kMargin, costs_.tempo, padded_,
                front.cost.data() + kMargin, ways.way.data());
    step_over_gaps(before, front, ways);
  }
  for (std::size_t c = 0; c < n_; ++c)
    if (!allowed_[c]) front.cost[kMargin + c] = kNever;
  std::fill(front.cost.begin() + static_cast<std::ptrdiff_t>(kMargin + n_), front.cost.end(), kNever);
}

void Search::step_over_gaps(const Front& before, Front& front, Ways& ways) const {
  const auto cost_of = [&](std::size_t c) { return c == n_ ? kNever : before.cost[kMargin + c]; };
  for (const std::size_t c : gaps_) {
    const float next = cost_of(before_[c]), skip = cost_of(second_[c]) + costs_.tempo;
    const float hold = before.hold_cost[kMargin + c], moved = std::min(next, skip);
    front.cost[kMargin + c] = std::min(moved, hold);
    ways.way[c] = hold < moved ? kHold : (skip < next ? kSkip : kNext);
  }
}

struct Origin {
  float cost;
  std::size_t candidate;
};

// The same with longer waits between holds and between skips, one candidate after the other.
void Search::step_within_limits(const Front& before, Front& front, Ways& ways) const {
  const auto one_more = [](std::uint8_t frames) {
    return static_cast<std::uint8_t>(std::min(frames + 1, PathCosts::kNever - 1));
  };
  const auto cost_of = [&](std::size_t c) { return c == n_ ? kNever : before.cost[kMargin + c]; };
  for (std::size_t c = 0; c < n_; ++c) {
    const std::size_t last = before_[c], second = second_[c];
    const bool may_skip = second != n_ && before.since_skip[second] >= costs_.skip_wait;
    const bool may_hold = may_stay_[c] || before.since_hold[c] >= costs_.hold_wait;
    const float next = cost_of(last), skip = may_skip ? cost_of(second) + costs_.tempo : kNever;
    const float hold = may_hold ? cost_of(c) + costs_.tempo : kNever, moved = std::min(next, skip);
    front.cost[kMargin + c] = std::min(moved, hold);
    const std::uint8_t way = hold < moved ? kHold : (skip < next ? kSkip : kNext);
    const std::size_t from = way == kHold ? c : (way == kSkip ? second : last);
    ways.way[c] = way;
    if (from == n_) continue;
    front.since_hold[c] = way == kHold ? 0 : one_more(before.since_hold[from]);
    front.since_skip[c] = way == kSkip ? 0 : one_more(before.since_skip[from]);
  }
}

SKINFORGE_VECTOR_CLONES bool any_below(const float* costs, float limit) {
  const auto below = Lanes::load(costs).v < limit;
  int any = 0;
  for (std::size_t k = 0; k < kBlock; ++k) any |= below[k];
  return any != 0;
}

// Candidates below a limit from which to jump: the cheapest few, cheapest first, of equals the first. Whole
// blocks.
std::vector<Origin> cheapest(std::span<const float> costs, float limit) {
  std::vector<Origin> best;
  const auto consider = [&](std::size_t c) {
    if (!(costs[c] < limit)) return;
    if (best.size() == kJumpOrigins) best.pop_back();
    const auto place = std::upper_bound(best.begin(), best.end(), costs[c],
                                        [](float cost, const Origin& origin) { return cost < origin.cost; });
    best.insert(place, {costs[c], c});
    if (best.size() == kJumpOrigins) limit = best.back().cost;
  };
  for (std::size_t block = 0; block < costs.size(); block += kBlock) {
    if (!any_below(costs.data() + block, limit)) continue;
    for (std::size_t c = block; c < block + kBlock; ++c) consider(c);
  }
  return best;
}

// What jumps to each candidate have to beat: its cost, or less than any cost where none may enter; and the
// largest of each block.
SKINFORGE_VECTOR_CLONES void find_costs_to_beat(const float* cost, const float* ceiling, std::size_t count,
                                                float* to_beat, float* dearest) {
  for (std::size_t c = 0; c < count; c += kBlock) {
    const Lanes beat = min(Lanes::load(cost + c), Lanes::load(ceiling + c));
    beat.store(to_beat + c);
    float most = beat.v[0];
    for (std::size_t k = 1; k < kBlock; ++k) most = beat.v[k] > most ? beat.v[k] : most;
    dearest[c / kBlock] = most;
  }
}

// Which of many blocks may hold a landing that is cheaper than what there is; most do not.
SKINFORGE_VECTOR_CLONES std::size_t blocks_that_may_gain(const float* dearest, const float* nearest,
                                                         float base, std::size_t count,
                                                         std::uint32_t* found) {
  std::size_t size = 0;
  for (std::size_t b = 0; b < count; b += kBlock) {
    const auto gains = (Lanes::load(nearest + b) + base).v < Lanes::load(dearest + b).v;
    int any = 0;
    for (std::size_t k = 0; k < kBlock; ++k) any |= gains[k];
    for (std::size_t k = 0; any && k < kBlock; ++k) {
      found[size] = static_cast<std::uint32_t>(b + k);
      size += gains[k] != 0;
    }
  }
  return size;
}

// Takes the landings of one block that are cheaper than what there is.
[[gnu::always_inline]] inline void land_on_block(const float* landing, float base, std::uint8_t way,
                                                 float* to_beat, float* cost, std::uint8_t* ways) {
  const Lanes total = Lanes::load(landing) + base, beat = Lanes::load(to_beat);
  const auto gains = total.v < beat.v;
  Lanes{gains ? total.v : beat.v}.store(to_beat);
  Lanes{gains ? total.v : Lanes::load(cost).v}.store(cost);
  for (std::size_t k = 0; k < kBlock; ++k) ways[k] = gains[k] ? way : ways[k];
}

SKINFORGE_VECTOR_CLONES void land_on_blocks(const std::uint32_t* blocks, std::size_t count,
                                            const float* landing, float base, std::uint8_t way,
                                            float* to_beat, float* cost, std::uint8_t* ways) {
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t c = blocks[i] * kBlock;
    land_on_block(landing + c, base, way, to_beat + c, cost + c, ways + c);
  }
}

const Row& Search::nearest_landings(std::size_t origin) const {
  Row& nearest = nearest_landings_[origin];
  if (!nearest.empty()) return nearest;
  nearest.assign(padded(padded_ / kBlock), kNever);
  const auto landing = landing_(static_cast<std::int32_t>(origin));
  for (std::size_t t = 0; t < n_; ++t) nearest[t / kBlock] = std::min(nearest[t / kBlock], landing[t]);
  return nearest;
}

void Search::land(std::size_t origin, float base, ToBeat& to_beat, Front& front, Ways& ways) const {
  std::vector<std::uint32_t>& blocks = to_beat.blocks;
  blocks.resize(to_beat.dearest.size());
  blocks.resize(blocks_that_may_gain(to_beat.dearest.data(), nearest_landings(origin).data(), base,
                                     to_beat.dearest.size(), blocks.data()));
  const auto way = static_cast<std::uint8_t>(kJump + ways.origins.size());
  ways.origins.push_back(static_cast<std::int32_t>(origin));
  if (blocks.empty()) return;
  const auto landing = landing_(static_cast<std::int32_t>(origin));
  const bool ends_short = blocks.back() == n_ / kBlock;
  land_on_blocks(blocks.data(), blocks.size() - ends_short, landing.data(), base, way, to_beat.cost.data(),
                 front.cost.data() + kMargin, ways.way.data());
  for (std::size_t t = n_ / kBlock * kBlock; ends_short && t < n_; ++t)
    if (base + landing[t] < to_beat.cost[t]) {
      to_beat.cost[t] = front.cost[kMargin + t] = base + landing[t];
      ways.way[t] = way;
    }
}

// `to_beat`: room that is used again.
void Search::jump_on(const Front& before, ToBeat& to_beat, Front& front, Ways& ways) const {
  find_costs_to_beat(front.cost.data() + kMargin, entry_.data(), padded_, to_beat.cost.data(),
                     to_beat.dearest.data());
  const float dearest = *std::max_element(to_beat.dearest.begin(), to_beat.dearest.end());
  const auto costs = std::span(before.cost).subspan(kMargin, padded_);
  for (const Origin& origin : cheapest(costs, dearest - costs_.jump))
    land(origin.candidate, origin.cost + costs_.jump, to_beat, front, ways);
  for (std::size_t t = 0; has_limits() && t < n_; ++t)
    if (ways.way[t] >= kJump) front.since_hold[t] = front.since_skip[t] = PathCosts::kNever - 1;
}

SKINFORGE_VECTOR_CLONES void add_row(const float* row, float tempo, const std::uint8_t* way,
                                     const std::uint8_t* may_stay, std::size_t count, float* cost,
                                     float* hold_cost) {
  for (std::size_t c = 0; c < count; ++c) {
    cost[c] += row[c];
    hold_cost[c] = way[c] == kHold && !may_stay[c] ? kNever : cost[c] + tempo;
  }
}

void Search::pay(std::size_t frame, const Ways& ways, Front& front) const {
  add_row(distances_.row(frame).data(), costs_.tempo, ways.way.data(), may_stay_.data(), n_,
          front.cost.data() + kMargin, front.hold_cost.data() + kMargin);
}

Ways Search::go_on(const Front& before, std::size_t frame, ToBeat& to_beat, Front& front) const {
  Ways ways{std::vector<std::uint8_t>(padded_), {}};
  step_on(before, front, ways);
  jump_on(before, to_beat, front, ways);
  pay(frame, ways, front);
  return ways;
}

std::size_t Search::before(std::size_t candidate, const Ways& ways) const {
  switch (ways.step(candidate)) {
    case PathStep::Next:
      return before_[candidate];
    case PathStep::Skip:
      return second_[candidate];
    case PathStep::Hold:
      return candidate;
    case PathStep::Jump:
      return static_cast<std::size_t>(ways.origin(candidate));
  }
  return candidate;
}

KeyframePath Search::run(std::span<const std::size_t> frames, std::int32_t fixed) const {
  Front last = first_front(frames.front(), fixed), next = last;
  ToBeat to_beat{Row(padded_), Row(padded(padded_ / kBlock), -kNever), {}};
  std::vector<Ways> all = {Ways{std::vector<std::uint8_t>(padded_), {}}};
  for (std::size_t k = 1; k < frames.size(); ++k) {
    all.push_back(go_on(last, frames[k], to_beat, next));
    std::swap(last, next);
  }
  const auto costs = std::span(last.cost).subspan(kMargin, n_);
  auto c = fixed >= 0
               ? static_cast<std::size_t>(fixed)
               : static_cast<std::size_t>(std::min_element(costs.begin(), costs.end()) - costs.begin());
  SF_EXPECT(costs[c] < kNever);
  KeyframePath path;
  for (std::size_t k = frames.size(); k-- > 0;) {
    path.candidates.push_back(static_cast<std::int32_t>(c));
    path.steps.push_back(all[k].step(c));
    if (k > 0) c = before(c, all[k]);
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
