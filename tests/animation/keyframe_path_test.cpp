#include "animation/keyframe_path.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "base/error.h"

namespace skinforge {
namespace {
using ::testing::ElementsAre;

// Candidates of one clip of `count` frames; poses a unit apart for every landing.
struct OneClip {
  FrameSteps steps;
  std::vector<bool> allowed;
  std::vector<float> zeros;
  LandingCosts no_cost;

  explicit OneClip(int count, bool cyclic = false)
      : allowed(static_cast<std::size_t>(count), true),
        zeros(static_cast<std::size_t>(count), 0.0F),
        no_cost([this](std::int32_t) { return std::span<const float>(zeros); }) {
    for (int k = 0; k < count; ++k) {
      steps.next.push_back(k + 1 < count ? k + 1 : (cyclic ? 0 : -1));
      steps.previous.push_back(k > 0 ? k - 1 : (cyclic ? count - 1 : -1));
    }
  }
  OneClip(const OneClip&) = delete;
};

DistanceTable table_of(const std::vector<std::vector<float>>& rows) {
  DistanceTable table{rows.size(), rows.front().size(), {}, {}, {}};
  for (const auto& row : rows) table.values.insert(table.values.end(), row.begin(), row.end());
  return table;
}

// By hand: frame by frame 0 4 2 is best by 0.01; going 0 1 2 saves two jumps.
TEST(KeyframePath, PrefersContinuityToALittleGain) {
  const OneClip clip(6);
  const DistanceTable d = table_of({{0, 1, 1, 1, 1, 1}, {1, 0.01F, 1, 1, 0, 1}, {1, 1, 0, 1, 1, 1}});
  EXPECT_THAT(best_path(d, clip.steps, clip.allowed, clip.no_cost, false).candidates, ElementsAre(0, 1, 2));
  EXPECT_THAT(best_frames(d, clip.steps, clip.allowed).candidates, ElementsAre(0, 4, 2));
}

// By hand: staying in order would cost 1 a frame, so the jump to the far end is worth it.
TEST(KeyframePath, JumpsWhenItPays) {
  const OneClip clip(6);
  const DistanceTable d = table_of({{0, 1, 1, 1, 1, 1}, {1, 1, 1, 1, 0, 1}, {1, 1, 1, 1, 1, 0}});
  const KeyframePath path = best_path(d, clip.steps, clip.allowed, clip.no_cost, false);
  EXPECT_THAT(path.candidates, ElementsAre(0, 4, 5));
  EXPECT_THAT(path.steps, ElementsAre(PathStep::Next, PathStep::Jump, PathStep::Next));
}

TEST(KeyframePath, DearLandingsAreAvoided) {
  const OneClip clip(6);
  const DistanceTable d = table_of({{0, 1, 1, 1, 1, 1}, {1, 1, 1, 0, 0.1F, 1}});
  const std::vector<float> landing = {0, 0, 0, 0.2F, 0, 0};
  const auto path = best_path(
      d, clip.steps, clip.allowed, [&](std::int32_t) { return std::span<const float>(landing); }, false);
  EXPECT_EQ(path.candidates[1], 4);
}

// A clip that ends is played, then held: nothing else comes near, and its end may not be entered directly.
TEST(KeyframePath, StaysAtTheEndOfAClip) {
  const OneClip clip(14);
  std::vector<std::vector<float>> rows(30, std::vector<float>(14, 0.2F));
  for (auto& row : rows) row[13] = 0;
  const KeyframePath path = best_path(table_of(rows), clip.steps, clip.allowed, clip.no_cost, false);
  EXPECT_LT(path.candidates.front(), 4);  // ten frames before the end
  EXPECT_EQ(path.candidates.back(), 13);
  EXPECT_EQ(std::count(path.steps.begin(), path.steps.end(), PathStep::Jump), 0);
  EXPECT_GT(std::count(path.candidates.begin(), path.candidates.end(), 13), 15);
}

// A still driving clip likes keyframe 0 best, yet it may not be held: the part keeps moving at half speed at
// least.
TEST(KeyframePath, NeverHoldsTwice) {
  const OneClip clip(8, true);
  std::vector<std::vector<float>> rows(12, std::vector<float>(8, 0.05F));
  for (auto& row : rows) row[0] = 0;
  const KeyframePath path = best_path(table_of(rows), clip.steps, clip.allowed, clip.no_cost, false);
  for (std::size_t k = 1; k < path.steps.size(); ++k)
    EXPECT_FALSE(path.steps[k] == PathStep::Hold && path.steps[k - 1] == PathStep::Hold);
}

TEST(KeyframePath, ForbiddenKeyframesAreNotChosen) {
  OneClip clip(3);
  clip.allowed = {false, true, true};
  const DistanceTable d = table_of({{0, 1, 1}, {0, 1, 1}});
  for (const std::int32_t c : best_path(d, clip.steps, clip.allowed, clip.no_cost, false).candidates)
    EXPECT_NE(c, 0);
  clip.allowed.assign(3, false);
  EXPECT_THROW(best_path(d, clip.steps, clip.allowed, clip.no_cost, false), Error);
}

// By hand: a loop of 5 frames over a cyclic clip of 6 with nothing to prefer closes by one skip, without a
// jump.
TEST(KeyframePath, LoopsCloseByTempo) {
  const OneClip clip(6, true);
  const DistanceTable d = table_of(std::vector<std::vector<float>>(5, std::vector<float>(6, 0.1F)));
  const KeyframePath path = best_path(d, clip.steps, clip.allowed, clip.no_cost, true);
  int advance = 0;
  for (const PathStep step : path.steps) {
    EXPECT_NE(step, PathStep::Jump);
    advance += step == PathStep::Hold ? 0 : (step == PathStep::Skip ? 2 : 1);
  }
  EXPECT_EQ(advance % 6, 0);
}

// Law: the path is what its steps say, and no dearer than the keyframes chosen one by one.
TEST(KeyframePath, BeatsTheChoiceFrameByFrame) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> uniform(0, 0.3F);
  const OneClip clip(80);
  const PathCosts costs;
  for (int trial = 0; trial < 5; ++trial) {
    std::vector<std::vector<float>> rows(30, std::vector<float>(80));
    for (auto& row : rows)
      for (float& x : row) x = uniform(random);
    const DistanceTable d = table_of(rows);
    const auto cost = [&](const KeyframePath& path) {
      float sum = 0;
      for (std::size_t f = 0; f < path.candidates.size(); ++f) {
        sum += d.row(f)[static_cast<std::size_t>(path.candidates[f])];
        if (f == 0 || path.steps[f] == PathStep::Next) continue;
        sum += path.steps[f] == PathStep::Jump ? costs.jump : costs.tempo;
      }
      return sum;
    };
    const KeyframePath path = best_path(d, clip.steps, clip.allowed, clip.no_cost, false, costs);
    EXPECT_LE(cost(path), cost(best_frames(d, clip.steps, clip.allowed)));
    for (std::size_t f = 1; f < path.candidates.size(); ++f) {
      const int moved = path.candidates[f] - path.candidates[f - 1];
      if (path.steps[f] == PathStep::Next) {
        EXPECT_EQ(moved, 1);
      }
      if (path.steps[f] == PathStep::Hold) {
        EXPECT_EQ(moved, 0);
      }
      if (path.steps[f] == PathStep::Skip) {
        EXPECT_EQ(moved, 2);
      }
    }
  }
}

// By hand: every keyframe wants to be passed at double speed. With a tempo of at most 1.25 one frame may be
// skipped in four, so 9 frames get no farther than 8 + 2.
TEST(KeyframePath, KeepsToTempoLimits) {
  const OneClip clip(40);
  std::vector<std::vector<float>> rows;
  for (int f = 0; f < 9; ++f) {
    rows.emplace_back(40, 0.1F);
    rows.back()[static_cast<std::size_t>(2 * f)] = 0;
  }
  const DistanceTable d = table_of(rows);
  const PathCosts free{.jump = 9}, slow{.hold_wait = PathCosts::kNever, .skip_wait = 3, .jump = 9},
      steady{.hold_wait = PathCosts::kNever, .skip_wait = PathCosts::kNever, .jump = 9};
  const auto length = [&](const PathCosts& costs) {
    const auto c = best_path(d, clip.steps, clip.allowed, clip.no_cost, false, costs).candidates;
    return c.back() - c.front();
  };
  EXPECT_EQ(length(free), 16);
  EXPECT_LE(length(slow), 10);
  EXPECT_EQ(length(steady), 8);
}

}  // namespace
}  // namespace skinforge
