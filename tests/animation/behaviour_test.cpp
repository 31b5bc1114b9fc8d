#include "animation/behaviour.h"

#include <gtest/gtest.h>

namespace skinforge {
namespace {

TEST(ShareAWord, WordsAndTheirBeginnings) {
  EXPECT_TRUE(share_a_word("Armature|Walk", "Walking_A"));
  EXPECT_TRUE(share_a_word("Idle", "AnimalArmature|Idle_2"));
  EXPECT_TRUE(share_a_word("RUN", "Running"));
  EXPECT_FALSE(share_a_word("Armature|Walk", "Armature|Run"));  // what stands before the bar is no name
  EXPECT_FALSE(share_a_word("Go_up", "Go_down"));               // too short to mean anything
  EXPECT_FALSE(share_a_word("", "Walk"));
  EXPECT_FALSE(share_a_word("Take 001", "001"));
}

// By hand: activities 0.2 against 0.9 and 0.2; the second clip has another name.
TEST(AddBehaviour, ByHand) {
  MotionSet driver, candidates;
  driver.activity = {9, 0.2F};
  candidates.activity = {0.9F, 0.2F};
  candidates.clip_begin = {0, 1, 2};
  DistanceTable table{1, 2, {0.3F, 0.3F}};
  add_behaviour(driver, 1, candidates, {true, false}, table);
  EXPECT_NEAR(table.values[0], 0.3 + 0.1 * 0.7, 1e-6);
  EXPECT_NEAR(table.values[1], 0.3 + 0.05, 1e-6);
  add_behaviour(driver, 1, candidates, {false, false}, table);  // no clip called alike: names do not count
  EXPECT_NEAR(table.values[1], 0.3 + 0.05, 1e-6);
}

}  // namespace
}  // namespace skinforge
