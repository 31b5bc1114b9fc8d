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

// By hand: a distance of 0.3 between frames 0.14 and 0.05 from their stances is 0.3 / (0.14 + 0.05 + 0.01)
// = 1.5 times that of unrelated motions, which costs 0.1, beside half of 0.3. Activities 0.2 against 1 and
// 0.2 differ by 0.8 and 0; the driver's clips differ by 1 - 0.5 / 1, the candidates' by 1 - 0.2 / 1, so that
// weighs 0.1 * 0.5 * 0.8. The second clip has another name.
TEST(AddBehaviour, ByHand) {
  MotionSet driver, candidates;
  driver.activity = {1, 0.8F, 0.2F};
  driver.clip_begin = {0, 1, 3};
  driver.is_moving = {true, true};
  candidates.activity = {1, 0.2F};
  candidates.clip_begin = {0, 1, 2};
  candidates.is_moving = {true, true};
  const DistanceTable distances{1, 2, {0.3F, 0.3F}, {0.14F}, {0.05F, 0.05F}};
  DistanceTable named = distances, nameless = distances;
  add_behaviour(driver, 2, candidates, {true, false}, named);
  EXPECT_NEAR(named.values[0], 0.3 + 0.04 * 0.8, 1e-6);
  EXPECT_NEAR(named.values[1], 0.3 + 0.1, 1e-6);
  add_behaviour(driver, 2, candidates, {false, false}, nameless);  // no clip called alike: names do not count
  EXPECT_NEAR(nameless.values[1], 0.3, 1e-6);
}

// A set with one clip cannot tell calm from lively.
TEST(AddBehaviour, OneClipHasNoLiveliness) {
  MotionSet driver, candidates;
  driver.activity = {1};
  driver.clip_begin = {0, 1};
  driver.is_moving = {true};
  candidates.activity = {1, 0.2F};
  candidates.clip_begin = {0, 1, 2};
  candidates.is_moving = {true, true};
  DistanceTable distances{1, 2, {0.2F, 0.2F}, {0.1F}, {0.1F, 0.1F}};
  add_behaviour(driver, 0, candidates, {false, false}, distances);
  EXPECT_EQ(distances.values[0], distances.values[1]);
}

}  // namespace
}  // namespace skinforge
