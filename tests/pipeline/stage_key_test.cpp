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

}  // namespace
}  // namespace skinforge
