#include "report/ledger.h"

#include <gmock/gmock.h>

#include "base/error.h"

namespace skinforge {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

Character character(const std::vector<std::string>& joints, const std::vector<std::string>& clips) {
  Character c;
  for (const std::string& name : joints) {
    c.skeleton.joints.emplace_back();
    c.skeleton.joints.back().name = name;
  }
  for (const std::string& name : clips) {
    c.clips.emplace_back();
    c.clips.back().name = name;
  }
  return c;
}

const LedgerEntry& entry(const Ledger& ledger, LedgerKind kind, const std::string& input,
                         const std::string& item) {
  for (const LedgerEntry& e : ledger)
    if (e.kind == kind && e.input == input && e.item == item) return e;
  throw Error(ExitCode::Internal, "no entry " + item);
}

/// horse: Root, Neck and the clip Walk; man: Spine, Hand and the clips Walk, Wave. Neck is replaced by Spine.
class Centaur : public ::testing::Test {
 protected:
  Character horse = character({"Root", "Neck"}, {"Walk"});
  Character man = character({"Spine", "Hand"}, {"Walk", "Wave"});
  Character result = character({"Root", "Spine", "Hand"}, {"Walk", "man_Walk", "Wave"});
  std::vector<LedgerInput> inputs{{"horse", &horse}, {"man", &man}};
  ResultOrigins origins{.joints = {{0, 0, ""}, {1, 0, "moved by its placement"}, {1, 1, ""}},
                        .clips = {{0, 0, ""}, {1, 0, ""}, {1, 1, ""}},
                        .materials = {},
                        .images = {},
                        .morphs = {},
                        .parts = {}};
};

TEST_F(Centaur, EveryItemOfEveryInputHasOneEntry) {
  EXPECT_EQ(build_ledger(inputs, result, origins).size(), 2U + 2 + 1 + 2);
}

TEST_F(Centaur, StatesByHand) {
  const Ledger ledger = build_ledger(inputs, result, origins);
  EXPECT_EQ(entry(ledger, LedgerKind::Joint, "horse", "Root").state, LedgerState::Kept);
  const auto& spine = entry(ledger, LedgerKind::Joint, "man", "Spine");
  EXPECT_EQ(spine.state, LedgerState::Changed);
  EXPECT_EQ(spine.reason, "moved by its placement");
  const auto& walk = entry(ledger, LedgerKind::Clip, "man", "Walk");
  EXPECT_EQ(walk.state, LedgerState::Changed);
  EXPECT_EQ(walk.reason, "renamed");
  EXPECT_THAT(walk.results, ElementsAre("man_Walk"));
  const auto& neck = entry(ledger, LedgerKind::Joint, "horse", "Neck");
  EXPECT_EQ(neck.state, LedgerState::Dropped);
  EXPECT_THAT(neck.results, IsEmpty());
  EXPECT_THAT(neck.reason, HasSubstr("replaced or removed"));
}

TEST_F(Centaur, CallersReasonWins) {
  const std::vector<DropReason> reasons{{LedgerKind::Joint, 0, 1, "replaced by operation 0"}};
  const Ledger ledger = build_ledger(inputs, result, origins, reasons);
  EXPECT_EQ(entry(ledger, LedgerKind::Joint, "horse", "Neck").reason, "replaced by operation 0");
}

// The same input twice: Hand has two copies, one renamed; the one that is as it was makes it kept.
TEST_F(Centaur, SeveralResultsOfOneItem) {
  result = character({"Root", "Spine", "Hand", "man_Hand"}, {"Walk", "man_Walk", "Wave"});
  origins.joints.push_back({1, 1, ""});
  const Ledger ledger = build_ledger(inputs, result, origins);
  const auto& hand = entry(ledger, LedgerKind::Joint, "man", "Hand");
  EXPECT_EQ(hand.state, LedgerState::Kept);
  EXPECT_THAT(hand.results, ElementsAre("Hand", "man_Hand"));
  EXPECT_EQ(hand.reason, "");
}

// Part 1 of the horse has two UV sets; the result keeps that part with one, and has a part made new.
TEST_F(Centaur, UvSetsFollowTheirPart) {
  horse.mesh.parts = {{"Eyes", 1, true, false}, {"Body", 2, true, false}};
  result.mesh.parts = {{"Body", 1, true, false}, {"Junction", 1, true, false}};
  origins.parts = {{0, 1, ""}, {}};
  const Ledger ledger = build_ledger(inputs, result, origins);
  EXPECT_EQ(entry(ledger, LedgerKind::UvSet, "horse", "Eyes UV0").state, LedgerState::Dropped);
  EXPECT_EQ(entry(ledger, LedgerKind::UvSet, "horse", "Body UV0").state, LedgerState::Kept);
  EXPECT_EQ(entry(ledger, LedgerKind::UvSet, "horse", "Body UV1").state, LedgerState::Dropped);
}

TEST_F(Centaur, TablesMustMatchTheResult) {
  origins.clips.pop_back();
  EXPECT_THROW(build_ledger(inputs, result, origins), Error);
}

TEST(Ledger, NothingInNothingOut) {
  EXPECT_TRUE(build_ledger({}, Character{}, ResultOrigins{}).empty());
}

}  // namespace
}  // namespace skinforge
