#include "pipeline/work_share.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

#include "pipeline/text_stage.h"

namespace skinforge {
namespace {

// Eight threads, a turn or a key each; the most that held one at a time.
template <class Take>
int most_at_a_time(Take take) {
  std::atomic<int> now = 0, most = 0;
  std::vector<std::thread> threads;
  for (int i = 0; i < 8; ++i)
    threads.emplace_back([&, i] {
      for (int round = 0; round < 200; ++round) {
        const auto held = take(i);
        int seen = ++now;
        for (int before = most; seen > before && !most.compare_exchange_weak(before, seen);) {
        }
        std::this_thread::yield();
        --now;
      }
    });
  for (std::thread& thread : threads) thread.join();
  return most;
}

TEST(WorkShare, GivesAsManyTurnsAsThereAreJobs) {
  for (const std::size_t jobs : {1U, 3U}) {
    WorkShare share(jobs);
    EXPECT_LE(most_at_a_time([&](int) { return share.take_turn(); }), static_cast<int>(jobs));
  }
}

// A budget that the process is over at once: stages run one after the other, and all of them run.
TEST(WorkShare, BeyondItsMemoryRunsOneAtATime) {
  WorkShare share(4, 1);
  EXPECT_EQ(most_at_a_time([&](int) { return share.take_turn(); }), 1);
}

TEST(WorkShare, AKeyBelongsToOneAtATime) {
  WorkShare share(8);
  EXPECT_EQ(most_at_a_time([&](int) { return share.claim(Digest{}); }), 1);
}

// Counts its runs.
class CountingStage final : public Stage {
 public:
  explicit CountingStage(std::atomic<int>& runs) : runs_(runs) {}
  StageInfo info() const override { return {.name = "count", .writes = {"count"}}; }
  void add_to_key(Hasher&) const override {}
  void run(const StageInput&, StageOutput& out, IssueSink&) const override {
    ++runs_;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    out.put("count", testing::bytes_of("1"));
  }

 private:
  std::atomic<int>& runs_;
};

TEST(WorkShare, WhatSeveralEnginesNeedRunsOnce) {
  MemoryStore store;
  Cache cache(store);
  WorkShare share(4);
  std::atomic<int> runs = 0;
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i)
    threads.emplace_back([&] {
      Engine engine(cache, {.share = &share});
      engine.add(std::make_unique<CountingStage>(runs));
      engine.run();
      EXPECT_TRUE(engine.is_ok());
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(runs, 1);
}

}  // namespace
}  // namespace skinforge
