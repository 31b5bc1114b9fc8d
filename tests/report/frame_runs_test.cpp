#include "report/frame_runs.h"

#include <gmock/gmock.h>

namespace skinforge {
namespace {

std::vector<ChosenFrame> forward(std::int64_t source, const std::string& clip, double begin, double first,
                                 int count, double step = 0.1) {
  std::vector<ChosenFrame> frames;
  for (int i = 0; i < count; ++i) frames.push_back({source, begin + 0.1 * i, clip, first + step * i});
  return frames;
}

void append(std::vector<ChosenFrame>& frames, const std::vector<ChosenFrame>& more) {
  frames.insert(frames.end(), more.begin(), more.end());
}

// Four frames of Walk from 0.5 s, then three of Run from 0: two runs.
TEST(FrameRuns, ByHand) {
  auto frames = forward(1, "Walk", 0, 0.5, 4);
  append(frames, forward(1, "Run", 0.4, 0, 3));
  const auto runs = frame_runs(frames);
  ASSERT_EQ(runs.size(), 2U);
  EXPECT_EQ(runs[0].clip, "Walk");
  EXPECT_EQ(runs[0].time, 0);
  EXPECT_DOUBLE_EQ(runs[0].clip_begin, 0.5);
  EXPECT_DOUBLE_EQ(runs[0].clip_end, 0.8);
  EXPECT_EQ(runs[0].frames, 4);
  EXPECT_EQ(runs[1].clip, "Run");
  EXPECT_DOUBLE_EQ(runs[1].time, 0.4);
  EXPECT_EQ(runs[1].frames, 3);
}

TEST(FrameRuns, JumpWithinAClipStartsARun) {
  auto frames = forward(1, "Walk", 0, 0, 3);
  append(frames, forward(1, "Walk", 0.3, 2, 3));
  EXPECT_EQ(frame_runs(frames).size(), 2U);
}

TEST(FrameRuns, BackwardsAndStandingStillAreRuns) {
  EXPECT_EQ(frame_runs(forward(1, "Walk", 0, 1, 5, -0.1)).size(), 1U);
  EXPECT_EQ(frame_runs(forward(1, "Walk", 0, 1, 5, 0)).size(), 1U);
  auto turn = forward(1, "Walk", 0, 1, 3);
  append(turn, forward(1, "Walk", 0.3, 1.1, 3, -0.1));
  EXPECT_EQ(frame_runs(turn).size(), 2U);
}

TEST(FrameRuns, SourcesAreKeptApart) {
  std::vector<ChosenFrame> mixed;
  for (int i = 0; i < 4; ++i)
    for (const std::int64_t source : {2, 1}) mixed.push_back({source, 0.1 * i, "Walk", 0.1 * i});
  const auto runs = frame_runs(mixed);
  ASSERT_EQ(runs.size(), 2U);
  EXPECT_EQ(runs[0].source, 1);
  EXPECT_EQ(runs[1].source, 2);
}

TEST(FrameRuns, EveryFrameIsInOneRun) {
  auto frames = forward(0, "A", 0, 0, 7);
  append(frames, forward(0, "B", 0.7, 3, 1));
  append(frames, forward(0, "A", 0.8, 0, 5, 0.07));
  std::int64_t total = 0;
  for (const FrameRun& run : frame_runs(frames)) total += run.frames;
  EXPECT_EQ(total, 13);
}

TEST(FrameRuns, NoFramesNoRuns) {
  EXPECT_TRUE(frame_runs({}).empty());
}

}  // namespace
}  // namespace skinforge
