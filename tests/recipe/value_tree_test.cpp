#include "recipe/value_tree.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace skinforge {
namespace {
using ::testing::HasSubstr;
using ::testing::SizeIs;

std::string json_failure(const std::string& text) {
  try {
    parse_json_text(text, "f.json");
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::Usage);
    return error.what();
  }
  return "no error";
}

std::string yaml_failure(const std::string& text) {
  try {
    parse_yaml_text(text, "f.yaml");
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::Usage);
    return error.what();
  }
  return "no error";
}

const Value& member(const Value& object, const std::string& key) {
  for (const auto& m : object.members)
    if (m.key == key) return m.value;
  throw std::out_of_range(key);
}

TEST(JsonText, ReadsEveryKindWithItsPlace) {
  const Value root =
      parse_json_text("// head\n{ \"a\": [1, -2.5e1, true],\n  /* x */ \"b\": null, \"c\": \"x\" }", "f");
  EXPECT_EQ(root.place.line, 2);
  EXPECT_EQ(root.place.column, 1);
  const Value& a = member(root, "a");
  ASSERT_THAT(a.items, SizeIs(3));
  EXPECT_EQ(a.items[1].number, -25);
  EXPECT_EQ(a.items[1].text, "-2.5e1");
  EXPECT_EQ(a.items[1].place.column, 12);
  EXPECT_TRUE(a.items[2].boolean);
  EXPECT_EQ(root.members[1].place.line, 3);
  EXPECT_EQ(root.members[1].place.column, 11);
  EXPECT_EQ(member(root, "b").kind, Value::Kind::Null);
  EXPECT_EQ(member(root, "c").text, "x");
}

TEST(JsonText, ReadsEscapes) {
  EXPECT_EQ(parse_json_text(R"("\"\\\/\b\f\n\r\té€😀")", "f").text,
            "\"\\/\b\f\n\r\t\xC3\xA9\xE2\x82\xAC\xF0\x9F\x98\x80");
  EXPECT_EQ(parse_json_text(R"("\u00e9\u20AC\ud83d\ude00")", "f").text,
            "\xC3\xA9\xE2\x82\xAC\xF0\x9F\x98\x80");
}

TEST(JsonText, CountsColumnsInCharacters) {
  EXPECT_EQ(json_failure("{\"\xC3\xA9\xE2\x82\xAC\": x}"), "f.json:1:8: expected a value, found \"x\"");
}

TEST(JsonText, NamesWhatIsWrong) {
  EXPECT_EQ(json_failure(""),
            "f.json:1:1: the file is empty; a recipe is an object with inputs, a base and ops");
  EXPECT_EQ(json_failure("\n /* x"), "f.json:2:2: this comment has no end");
  EXPECT_EQ(json_failure("{\"a\": 1,\n \"a\": 2}"), "f.json:2:2: duplicate key \"a\" (first at line 1)");
  EXPECT_EQ(json_failure("{\"a\": 1,}"), "f.json:1:9: expected a key in quotes, found \"}\"");
  EXPECT_EQ(json_failure("[1,]"), "f.json:1:4: expected a value, found \"]\"");
  EXPECT_EQ(json_failure("{\"a\" 1}"), "f.json:1:6: expected \":\", found \"1\"");
  EXPECT_EQ(json_failure("{\"a\": 1 \"b\": 2}"), "f.json:1:9: expected \",\" or \"}\", found \"\"\"");
  EXPECT_EQ(json_failure("[1 2]"), "f.json:1:4: expected \",\" or \"]\", found \"2\"");
  EXPECT_EQ(json_failure("[1"), "f.json:1:3: expected \",\" or \"]\", found the end of the file");
  EXPECT_EQ(json_failure("{} {}"), "f.json:1:4: text after the end of the recipe");
  EXPECT_EQ(json_failure("\"ab\nc\""), "f.json:1:1: this string has no end");
  EXPECT_EQ(json_failure("\"a\tb\""), "f.json:1:3: control character in a string");
  EXPECT_EQ(json_failure("\"\\x\""), "f.json:1:3: unknown escape \\\"x\"");
  EXPECT_EQ(json_failure("\"\\ud83d\""), "f.json:1:8: half of a surrogate pair");
  EXPECT_EQ(json_failure("\"\\u12g4\""), "f.json:1:6: expected four hexadecimal digits");
  EXPECT_EQ(json_failure("nul"), "f.json:1:1: expected a value, found \"n\"");
}

TEST(JsonText, RefusesNumbersThatAreNone) {
  for (const char* text :
       {"01", "1.", "-", "1e", "+1", ".5", "1e999", "-1e999", "0x10", "NaN", "Infinity", "--1", "1.2.3"})
    EXPECT_NE(json_failure(text), "no error") << text;
  for (const char* text : {"0", "-0", "1.5", "1e3", "1E+3", "2e-3", "0.1"})
    EXPECT_EQ(json_failure(text), "no error") << text;
}

TEST(JsonText, BoundsItsDepth) {
  const auto nested = [](int depth) { return std::string(depth, '[') + std::string(depth, ']'); };
  EXPECT_EQ(json_failure(nested(kMaxRecipeDepth)), "no error");
  EXPECT_THAT(json_failure(nested(kMaxRecipeDepth + 1)), HasSubstr("nested deeper than 32 levels"));
  EXPECT_THAT(json_failure(std::string(1 << 20, '[')), HasSubstr("nested deeper"));
}

// Every prefix and every one-byte change of a document either parses or is one clean error.
TEST(JsonText, SurvivesDamage) {
  const std::string whole = R"({"a": [1.5, "x\u00e9\n", {"b": null}], /* c */ "d": true})";
  for (std::size_t i = 0; i < whole.size(); ++i) {
    EXPECT_THAT(json_failure(whole.substr(0, i)), HasSubstr("f.json:1:"));
    for (int bit = 0; bit < 7; ++bit) {
      std::string damaged = whole;
      damaged[i] = static_cast<char>(damaged[i] ^ (1 << bit));
      EXPECT_EQ(json_failure(damaged).find('\n'), std::string::npos);
    }
  }
}

TEST(RecipeText, IsBoundedUtf8) {
  const auto failure = [](const std::string& text) -> std::string {
    try {
      expect_recipe_text(text, "f");
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_EQ(failure("\xC3\xA9 \xF0\x9F\x98\x80"), "no error");
  EXPECT_EQ(failure("a\n\xC3\xA9\xFF"), "f:2:2: this is not UTF-8 text");
  for (const char* bad :
       {"\x80", "\xC3", "\xC0\x80", "\xE0\x80\x80", "\xED\xA0\x80", "\xF4\x90\x80\x80", "\xF8"})
    EXPECT_EQ(failure(bad), "f:1:1: this is not UTF-8 text");
  EXPECT_EQ(failure(std::string("a\0b", 3)), "f:1:2: this is not UTF-8 text");
  EXPECT_EQ(failure(std::string(kMaxRecipeBytes, 'a')), "no error");
  EXPECT_THAT(failure(std::string(kMaxRecipeBytes + 1, 'a')), HasSubstr("at most 1048576 bytes"));
}

TEST(YamlText, ReadsTheSameTree) {
  const Value root = parse_yaml_text("a: [1, -2.5e1, true]\nb: ~\nc: x\nd:\n  - \"1\"\n  - 'no'\n", "f");
  EXPECT_EQ(member(root, "a").items[1].number, -25);
  EXPECT_TRUE(member(root, "a").items[2].boolean);
  EXPECT_EQ(member(root, "b").kind, Value::Kind::Null);
  EXPECT_EQ(member(root, "c").text, "x");
  EXPECT_EQ(member(root, "d").items[0].kind, Value::Kind::String);
  EXPECT_FALSE(member(root, "d").items[1].is_ambiguous);
  EXPECT_EQ(member(root, "d").items[1].place.line, 6);
  EXPECT_EQ(member(root, "d").items[1].place.column, 5);
}

TEST(YamlText, TypesPlainWordsByJsonsRules) {
  for (const char* text :
       {"0x10", "0o7", "010", ".5", "1_000", ".nan", ".inf", "True", "12:30", "2026-01-01"})
    EXPECT_EQ(parse_yaml_text(text, "f").kind, Value::Kind::String) << text;
  for (const char* text : {"no", "Yes", "ON", "off", "y"})
    EXPECT_TRUE(parse_yaml_text(text, "f").is_ambiguous) << text;
  EXPECT_EQ(parse_yaml_text("1e3", "f").number, 1000);
}

TEST(YamlText, RefusesWhatARecipeDoesNotNeed) {
  EXPECT_EQ(yaml_failure("a: &x 1\nb: 2"), "f.yaml:1:4: anchors (&name) are not read");
  EXPECT_THAT(yaml_failure("a: &x [1]\nb: *x"), HasSubstr("anchors"));
  EXPECT_EQ(yaml_failure("a: !!str 1"), "f.yaml:1:4: tags (!name) are not read");
  EXPECT_THAT(yaml_failure("a: !thing {b: 1}"), HasSubstr("tags (!name) are not read"));
  EXPECT_EQ(yaml_failure("<<: {a: 1}"), "f.yaml:1:1: merge keys (<<) are not read");
  EXPECT_THAT(yaml_failure("a: 1\n---\nb: 2"), HasSubstr("one YAML document"));
  EXPECT_EQ(yaml_failure("a: 1\na: 2"), "f.yaml:2:1: duplicate key \"a\" (first at line 1)");
  EXPECT_THAT(yaml_failure("? [a]\n: 1"), HasSubstr("a key must be plain text"));
  EXPECT_THAT(yaml_failure("? {a: 1}\n: 1"), HasSubstr("a key must be plain text"));
  EXPECT_THAT(yaml_failure(""), HasSubstr("the file is empty"));
  EXPECT_THAT(yaml_failure("a: [1, 2"), HasSubstr("f.yaml:1:"));
  EXPECT_THAT(yaml_failure("a: b: c"), HasSubstr("f.yaml:1:"));
  EXPECT_THAT(yaml_failure(std::string(40, '[') + std::string(40, ']')),
              HasSubstr("nested deeper than 32 levels"));
}

// What two strings have in common when they are printed, they have in common.
TEST(ValueText, IsReadBackAsItWas) {
  for (const std::string text : {"e\\nts", "a\nb", "\\x0a", "\"", "tab\t", "\x7f", "\xC3\xA9"}) {
    Value value;
    value.kind = Value::Kind::String;
    value.text = text;
    EXPECT_EQ(parse_json_text(value_text(value), "again").text, text);
  }
}

}  // namespace
}  // namespace skinforge
