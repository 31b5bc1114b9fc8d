#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace skinforge {

/// Where something stands in a text: line and column from 1, columns in characters.
struct TextPlace {
  int line = 1;
  int column = 1;
};

/// A value of a recipe file that remembers where it stood. JSON and YAML are read into the same tree.
struct Value {
  enum class Kind { Null, Bool, Number, String, Array, Object };
  struct Member;

  Kind kind = Kind::Null;
  TextPlace place;
  bool boolean = false;
  double number = 0;            ///< finite
  std::string text;             ///< of a string; of a number as it was written
  bool is_ambiguous = false;    ///< YAML's plain yes, no, on, off: a string to us, a boolean to others
  std::vector<Value> items;     ///< of an array
  std::vector<Member> members;  ///< of an object, in file order, each key once
  std::shared_ptr<const std::string> file;  ///< where it stands; null where nobody said
  std::string origin;                       ///< of a value from elsewhere: "--set scale=1.2"

  /// "the string \"x\"", "the number 1e3", "an object", ... for messages.
  std::string describe() const;
  /// The member of that key; null where there is none.
  const Value* find(std::string_view key) const;
  Value* find(std::string_view key);
  /// Path of the file; empty where nobody said.
  std::string file_name() const { return file ? *file : std::string(); }
  /// "centaur.json:12:9", or the origin.
  std::string where() const;
};

struct Value::Member {
  std::string key;
  TextPlace place;
  Value value;
};

/// The value as JSON in one line, numbers in their shortest form: equal values give equal texts.
std::string value_text(const Value& value);

constexpr std::size_t kMaxRecipeBytes = 1 << 20;  // ours: a thousand times the largest recipe written so far
constexpr int kMaxRecipeDepth = 32;               // ours: recipes need 6

/// Error (Usage) "FILE:LINE:COLUMN: message".
Error text_error(const std::string& file, const TextPlace& place, const std::string& message);

/// Checks what both readers take for granted: at most `kMaxRecipeBytes`, valid UTF-8, no zero byte. Throws
/// Error (Usage) with the place.
void expect_recipe_text(std::string_view text, const std::string& file);

/// Reads JSON with // and /* */ comments (RFC 8259 otherwise: no trailing commas, no NaN, valid UTF-8). A key
/// that occurs twice and more than `kMaxRecipeDepth` levels are errors. `file` leads each message. Throws
/// Error (Usage).
Value parse_json_text(std::string_view text, const std::string& file);

/// Reads one YAML document with the same limits. Plain scalars are typed by JSON's rules only: true, false,
/// null (also ~ and nothing) and JSON numbers; all others are strings. Anchors, aliases, tags, merge keys and
/// further documents are errors. Throws Error (Usage).
Value parse_yaml_text(std::string_view text, const std::string& file);

/// The number that `text` spells by JSON's grammar, for both readers. False when it is none; an infinite
/// result counts as none.
bool parse_json_number(std::string_view text, double& number);

}  // namespace skinforge
