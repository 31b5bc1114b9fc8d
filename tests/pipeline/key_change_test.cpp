#include "pipeline/key_change.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace skinforge {
namespace {
using Kind = KeyChange::Kind;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

struct TwoRuns {
  StageKey now{.digest = sha256({}),
               .build = "2",
               .parameters = {{"scale", "1.2"}, {"new", "n"}},
               .inputs = {{"x", "1"}}};
  Manifest last;
  StageInfo info{.name = "place", .version = 3, .writes = {"placement"}};
  Settings settings_now, settings_then;

  TwoRuns() {
    last.build = std::string("1");
    last.version = 1;
    last.parameters = {{"scale", "1"}, {"old", "o"}};
    last.inputs = {{"x", "0"}, {"y", "0"}};
  }
  std::vector<KeyChange> changes(const ReadsSetting& reads = {}) const {
    return key_changes(info, now, settings_now, {Digest(), last, settings_then}, reads);
  }
};

TEST(KeyChanges, ListEveryDifference) {
  const TwoRuns runs;
  EXPECT_EQ(why_run(runs.changes()),
            "the tool changed; stage version 1 -> 3; parameter scale: 1 -> 1.2; parameter new is new: n; "
            "parameter old is gone; input x changed; input y is gone");
}

TEST(KeyChanges, WithoutAnEarlierRun) {
  const TwoRuns runs;
  const auto changes = [&](EarlierRun earlier) {
    return key_changes(runs.info, runs.now, {}, std::move(earlier), {});
  };
  EXPECT_EQ(why_run(changes({})), "never run");
  EXPECT_EQ(why_run(changes({Digest(), {}, {}})), "its last run is no longer in the cache");
  EXPECT_THAT(changes({runs.now.digest, {}, {}}), IsEmpty());
}

// A struct in the key shows as a digest; the setting that changed says what it was. Settings of other stages
// and those that did not change are left out, a parameter with a value of its own stays.
TEST(KeyChanges, SettingsStandForDigests) {
  TwoRuns runs;
  runs.last.build = runs.now.build, runs.last.version = 3, runs.last.inputs = runs.now.inputs;
  runs.last.parameters = {{"options", "sha256:aaaaaaaaaaaa"}, {"names", "[a]"}};
  runs.now.parameters = {{"options", "sha256:bbbbbbbbbbbb"}, {"names", "[a, b]"}};
  runs.settings_then = {{"/scale", "1"}, {"/same", "1"}, {"/of_others", "1"}, {"/gone", "3"}};
  runs.settings_now = {{"/scale", "2"}, {"/same", "1"}, {"/of_others", "2"}};
  const auto reads = [](const StageInfo&, std::string_view setting) { return setting != "/of_others"; };
  EXPECT_THAT(runs.changes(reads), ElementsAre(KeyChange{Kind::Setting, "/gone", "3", std::nullopt},
                                               KeyChange{Kind::Setting, "/scale", "1", "2"},
                                               KeyChange{Kind::Parameter, "names", "[a]", "[a, b]"}));
  runs.now.parameters = runs.last.parameters;  // settings that change no parameter explain nothing
  EXPECT_EQ(why_run(runs.changes(reads)), "the order of its inputs changed");
}

TEST(KeyChanges, AnInputThatIsNotMadeYet) {
  TwoRuns runs;
  runs.last.build = runs.now.build, runs.last.version = 3, runs.last.parameters = runs.now.parameters;
  runs.last.inputs = {{"x", "0"}};
  runs.now.inputs = {{"x", ""}};
  EXPECT_THAT(runs.changes(), ElementsAre(KeyChange{Kind::Pending, "x", "0", std::nullopt}));
}

TEST(WhyRun, StaysOneLine) {
  StageKey now;
  now.digest = sha256({});
  Manifest last;
  for (int i = 0; i < 10; ++i) {
    now.inputs.push_back({std::to_string(i), "new"});
    last.inputs.push_back({std::to_string(i), "old"});
  }
  const StageInfo info{.name = "export", .version = 0, .writes = {"glb"}};
  const std::string reason = why_run(key_changes(info, now, {}, {Digest(), last, {}}, {}));
  EXPECT_TRUE(reason.ends_with("input 7 changed; 2 more")) << reason;
}

// A stage that did not get a new key keeps the settings under which it got the one it has.
TEST(RunRecord, KeepsTheSettingsOfEachKey) {
  const Digest one = sha256({}), two = Digest();
  const Settings first = {{"/scale", "1"}}, second = {{"/scale", "2"}};
  RunRecord run;
  run.note("place", one, first);
  run.note("field", one, first);
  run.note("place", two, second);
  run.note("field", one, second);
  run.tidy();
  EXPECT_EQ(run.settings_of("place"), second);
  EXPECT_EQ(run.settings_of("field"), first);
  EXPECT_THAT(run.settings_of("junction"), IsEmpty());
  EXPECT_EQ(parse_run_record(run_record_text(run)), run);
  EXPECT_EQ(run.id().size(), 8u);
  run.note("field", two, second);
  run.tidy();
  EXPECT_THAT(run.settings, ElementsAre(second));
  EXPECT_FALSE(parse_run_record("{\"stages\": {\"a\": [\"x\", 0]}, \"settings\": []}"));
  EXPECT_FALSE(parse_run_record("nonsense"));
}

}  // namespace
}  // namespace skinforge
