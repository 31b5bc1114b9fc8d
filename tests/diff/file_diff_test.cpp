#include "diff/file_diff.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "diff/diff_text.h"
#include "testing/toy_character.h"

namespace skinforge {
namespace {
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using testing::ToyCharacter;

constexpr const char* kOld =
    R"({"version": "0.1.0", "recipe_sha256": "aaaaaaaaaaaaaaaa", "content_sha256": "1", "preview": true,
        "inputs": {"horse": [{"file": "horse.glb", "sha256": "0123456789abcdef"},
                             {"file": "old.bin", "sha256": "55"}]}})";
constexpr const char* kNew =
    R"({"version": "0.2.0", "recipe_sha256": "bbbbbbbbbbbbbbbb", "content_sha256": "2",
        "inputs": {"horse": [{"file": "horse.glb", "sha256": "fedcba9876543210"}],
                   "man": [{"file": "man.glb", "sha256": "77"}]}})";

TEST(FileDiff, SaysWhatWasOtherwise) {
  EXPECT_THAT(compare_provenance(kOld, kNew),
              ElementsAre("input \"horse\", file \"horse.glb\": 0123456789ab -> fedcba987654",
                          "input \"horse\", file \"old.bin\": 55 -> none", "preview: true -> none",
                          "recipe: aaaaaaaaaaaa -> bbbbbbbbbbbb", "tool version: 0.1.0 -> 0.2.0",
                          "input \"man\", file \"man.glb\": none -> 77"));
}

TEST(FileDiff, OfTheSameOrNoneIsNothing) {
  EXPECT_THAT(compare_provenance(kOld, kOld), IsEmpty());
  EXPECT_THAT(compare_provenance("", kNew), IsEmpty());
  EXPECT_THAT(compare_provenance(kOld, ""), IsEmpty());
}

// Anybody may have written it.
TEST(FileDiff, OddProvenanceIsNoFault) {
  for (const char* odd : {"5", "[1]", "{", R"({"inputs": [1]})", R"({"inputs": {"a": 5}})",
                          R"({"inputs": {"a": [{"file": 5, "sha256": []}]}})", R"({"version": {"a": [1]}})"})
    EXPECT_NO_THROW(compare_provenance(odd, kNew)) << odd;
}

FileFacts breaking(std::vector<BrokenRule> rules) {
  return {.broken = std::move(rules)};
}

TEST(FileDiff, CountsBrokenRules) {
  const FileFacts a = breaking({{"A", true, 2}, {"B", true, 1}, {"W", false, 1}}),
                  b = breaking({{"A", true, 3}, {"B", true, 1}, {"E", true, 4}});
  const std::vector<RuleDelta> rules = compare_rules(a, b);
  ASSERT_EQ(rules.size(), 3U);
  EXPECT_EQ(rules[0].code, "A");
  EXPECT_EQ(rules[0].in_a, 2U);
  EXPECT_EQ(rules[0].in_b, 3U);
  EXPECT_EQ(rules[2].code, "W");
  EXPECT_FALSE(rules[2].is_error);
  EXPECT_THAT(edits_of(rules), ElementsAre("glTF error E is new"));
  EXPECT_THAT(compare_rules(a, a), IsEmpty());
  EXPECT_THAT(compare_rules({}, b), IsEmpty());  // an FBX has no such rules
}

// A new error is an edit of the structure, and over its limit; what a file was made of never is.
TEST(FileDiff, OnlyAnErrorIsOver) {
  const Character c = ToyCharacter::make();
  FileFacts a = breaking({}), b = breaking({{"NODE_LOOP", true, 1}});
  const CharacterDiff worse = compare_characters(c, c, {.a = a, .b = b});
  EXPECT_THAT(worse.structure.edits, ElementsAre("glTF error NODE_LOOP is new"));
  EXPECT_TRUE(is_over(judge(worse, {})));
  EXPECT_FALSE(is_over(judge(worse, {.structure = false})));
  EXPECT_THAT(to_text(worse, judge(worse, {})), HasSubstr("glTF error NODE_LOOP: 0 -> 1\n"));
  EXPECT_EQ(to_json(worse, {}).at("rules").at(0).at("b"), 1);
  EXPECT_FALSE(is_over(judge(compare_characters(c, c, {.a = b, .b = a}), {})));

  a = {.provenance = kOld};
  b = {.provenance = R"({"version": "0.2\u001b[1m"})"};
  const CharacterDiff other = compare_characters(c, c, {.a = a, .b = b});
  EXPECT_FALSE(is_over(judge(other, {})));
  EXPECT_THAT(to_text(other, {}), HasSubstr("provenance, tool version: 0.1.0 -> 0.2"));
  EXPECT_THAT(to_text(other, {}), Not(HasSubstr("\x1b")));
  EXPECT_EQ(to_json(other, {}).at("provenance").size(), 5U);
}

}  // namespace
}  // namespace skinforge
