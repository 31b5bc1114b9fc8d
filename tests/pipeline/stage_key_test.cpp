#include "pipeline/stage_key.h"

#include <gtest/gtest.h>

#include <set>

#include "pipeline/text_stage.h"

namespace skinforge {
namespace {

struct KeyParts {
  StageInfo info = {.name = "blend", .instance = "walk", .version = 1, .reads = {"x", "y"}, .writes = {"z"}};
  std::string parameter = "p";
  std::string build = "1.0";
  std::vector<Digest> inputs = {sha256(testing::bytes_of("x")), sha256(testing::bytes_of("y"))};

  Digest digest() const {
    const testing::TextStage stage(info, parameter, testing::counter());
    return stage_key(stage, info, build, inputs).digest;
  }
};

TEST(StageKey, EachOfItsPartsMatters) {
  std::set<Digest> keys = {KeyParts().digest()};
  const auto expect_new = [&](const char* what, auto&& change) {
    KeyParts parts;
    change(parts);
    EXPECT_TRUE(keys.insert(parts.digest()).second) << what;
  };
  expect_new("name", [](KeyParts& p) { p.info.name = "blent"; });
  expect_new("version", [](KeyParts& p) { p.info.version = 2; });
  expect_new("parameter", [](KeyParts& p) { p.parameter = "q"; });
  expect_new("empty parameter", [](KeyParts& p) { p.parameter = ""; });
  expect_new("build", [](KeyParts& p) { p.build = "1.1"; });
  expect_new("one input", [](KeyParts& p) { p.inputs[1].bytes[31] ^= 1; });
  expect_new("order of inputs", [](KeyParts& p) { std::swap(p.inputs[0], p.inputs[1]); });
  expect_new("one input less", [](KeyParts& p) { p.inputs.pop_back(); });
  expect_new("one output more", [](KeyParts& p) { p.info.writes.push_back("w"); });
}

TEST(StageKey, NamesOfArtifactsAndInstancesDoNotMatter) {
  KeyParts other;
  other.info.instance = "run";
  other.info.reads = {"u", "v"};
  other.info.writes = {"w"};
  EXPECT_EQ(other.digest(), KeyParts().digest());
}

// A field that moves from one name to the next must not give the same key.
TEST(StageKey, FieldsDoNotRunIntoEachOther) {
  struct TwoTexts final : Stage {
    std::string first, second;
    TwoTexts(std::string f, std::string s) : first(std::move(f)), second(std::move(s)) {}
    StageInfo info() const override { return {.name = "two"}; }
    void add_to_key(Hasher& key) const override {
      key.add("first", first);
      key.add("second", second);
    }
    void run(const StageInput&, StageOutput&, IssueSink&) const override {}
  };
  const TwoTexts a("ab", "c"), b("a", "bc");
  EXPECT_NE(stage_key(a, a.info(), "", {}).digest, stage_key(b, b.info(), "", {}).digest);
}

TEST(StageKey, RecordsWhatWentIn) {
  const KeyParts parts;
  const testing::TextStage stage(parts.info, "p", testing::counter());
  const StageKey key = stage_key(stage, parts.info, "1.0", parts.inputs);
  EXPECT_EQ(key.parameters, (std::vector<HashedField>{{"parameter", "p"}}));
  EXPECT_EQ(key.inputs,
            (std::vector<HashedField>{{"x", parts.inputs[0].hex()}, {"y", parts.inputs[1].hex()}}));
}

TEST(WhyRun, ListsEveryDifference) {
  StageKey now{.digest = sha256({}),
               .build = "2",
               .parameters = {{"scale", "1.2"}, {"new", "n"}},
               .inputs = {{"x", "1"}}};
  Manifest last;
  last.build = "1";
  last.version = 1;
  last.parameters = {{"scale", "1"}, {"old", "o"}};
  last.inputs = {{"x", "0"}, {"y", "0"}};
  const StageInfo info{.name = "place", .version = 3};
  EXPECT_EQ(why_run(info, now, Digest(), last),
            "the tool changed; stage version 1 -> 3; parameter scale: 1 -> 1.2; parameter new is new: n; "
            "parameter old is gone; input x changed; input y is gone");
  EXPECT_EQ(why_run(info, now, std::nullopt, std::nullopt), "never run");
  EXPECT_EQ(why_run(info, now, now.digest, last), "its cache entry is missing or damaged");
  EXPECT_EQ(why_run(info, now, Digest(), std::nullopt), "its last run is no longer in the cache");
}

TEST(WhyRun, StaysOneLine) {
  StageKey now;
  Manifest last;
  for (int i = 0; i < 10; ++i) {
    now.inputs.push_back({std::to_string(i), "new"});
    last.inputs.push_back({std::to_string(i), "old"});
  }
  const std::string reason = why_run({.name = "export", .version = 0}, now, sha256({}), last);
  EXPECT_TRUE(reason.ends_with("input 7 changed; 2 more")) << reason;
}

}  // namespace
}  // namespace skinforge
