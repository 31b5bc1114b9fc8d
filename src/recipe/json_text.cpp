#include <fmt/core.h>

#include <algorithm>
#include <cstdint>

#include "base/text.h"
#include "recipe/value_tree.h"

namespace skinforge {

namespace {
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

bool is_continuation(char c) {
  return (static_cast<unsigned char>(c) & 0xC0) == 0x80;
}

void append_utf8(std::string& text, std::uint32_t code) {
  const auto put = [&](std::uint32_t byte) { text.push_back(static_cast<char>(byte)); };
  if (code < 0x80) {
    put(code);
  } else if (code < 0x800) {
    put(0xC0 | (code >> 6));
    put(0x80 | (code & 0x3F));
  } else if (code < 0x10000) {
    put(0xE0 | (code >> 12));
    put(0x80 | ((code >> 6) & 0x3F));
    put(0x80 | (code & 0x3F));
  } else {
    put(0xF0 | (code >> 18));
    put(0x80 | ((code >> 12) & 0x3F));
    put(0x80 | ((code >> 6) & 0x3F));
    put(0x80 | (code & 0x3F));
  }
}

// Recursive descent over the text; depth is bounded by kMaxRecipeDepth.
class JsonParser {
 public:
  JsonParser(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  Value document() {
    if (text_.starts_with(kByteOrderMark)) at_ += kByteOrderMark.size();
    skip_space();
    if (is_end()) fail("the file is empty; a recipe is an object with inputs, a base and ops");
    Value value = this->value(1);
    skip_space();
    if (!is_end()) fail("text after the end of the recipe");
    return value;
  }

 private:
  bool is_end() const { return at_ == text_.size(); }
  char peek() const { return is_end() ? '\0' : text_[at_]; }
  TextPlace place() const { return {line_, column_}; }

  [[noreturn]] void fail(const std::string& message) const { fail_at(place(), message); }
  [[noreturn]] void fail_at(const TextPlace& where, const std::string& message) const {
    throw text_error(file_, where, message);
  }

  char next() {
    const char c = text_[at_++];
    if (c == '\n') {
      ++line_;
      column_ = 1;
    } else if (is_end() || !is_continuation(text_[at_])) {
      ++column_;
    }
    return c;
  }

  bool take(std::string_view word) {
    if (!text_.substr(at_).starts_with(word)) return false;
    for (std::size_t i = 0; i < word.size(); ++i) next();
    return true;
  }

  void skip_space() {
    while (!is_end()) {
      if (std::string_view(" \t\r\n").find(peek()) != std::string_view::npos)
        next();
      else if (!skip_comment())
        return;
    }
  }

  bool skip_comment() {
    const TextPlace begin = place();
    if (take("//")) {
      while (!is_end() && peek() != '\n') next();
      return true;
    }
    if (!take("/*")) return false;
    while (!take("*/")) {
      if (is_end()) fail_at(begin, "this comment has no end");
      next();
    }
    return true;
  }

  // What stands at the current place, for messages.
  std::string found() const {
    if (is_end()) return "the end of the file";
    std::size_t length = 1;
    while (at_ + length < text_.size() && is_continuation(text_[at_ + length])) ++length;
    return fmt::format("\"{}\"", printable(text_.substr(at_, length)));
  }

  Value value(int depth) {
    if (depth > kMaxRecipeDepth) fail(fmt::format("nested deeper than {} levels", kMaxRecipeDepth));
    Value result;
    result.place = place();
    const char c = peek();
    if (c == '{') {
      object(result, depth);
    } else if (c == '[') {
      array(result, depth);
    } else if (c == '"') {
      result.kind = Value::Kind::String;
      result.text = string();
    } else if (c == '-' || (c >= '0' && c <= '9')) {
      number(result);
    } else {
      word(result);
    }
    return result;
  }

  void object(Value& result, int depth) {
    result.kind = Value::Kind::Object;
    next();
    skip_space();
    if (take("}")) return;
    do {
      skip_space();
      if (peek() != '"') fail("expected a key in quotes, found " + found());
      Value::Member member{{}, place(), {}};
      member.key = string();
      for (const auto& other : result.members)
        if (other.key == member.key)
          fail_at(member.place, fmt::format("duplicate key \"{}\" (first at line {})", printable(member.key),
                                            other.place.line));
      skip_space();
      if (!take(":")) fail("expected \":\", found " + found());
      skip_space();
      member.value = value(depth + 1);
      result.members.push_back(std::move(member));
      skip_space();
    } while (take(","));
    if (!take("}")) fail("expected \",\" or \"}\", found " + found());
  }

  void array(Value& result, int depth) {
    result.kind = Value::Kind::Array;
    next();
    skip_space();
    if (take("]")) return;
    do {
      skip_space();
      result.items.push_back(value(depth + 1));
      skip_space();
    } while (take(","));
    if (!take("]")) fail("expected \",\" or \"]\", found " + found());
  }

  std::string string() {
    const TextPlace begin = place();
    std::string text;
    next();
    while (true) {
      if (is_end() || peek() == '\n') fail_at(begin, "this string has no end");
      if (static_cast<unsigned char>(peek()) < 0x20) fail("control character in a string");
      const char c = next();
      if (c == '"') return text;
      if (c == '\\')
        escape(text);
      else
        text.push_back(c);
    }
  }

  void escape(std::string& text) {
    static constexpr std::string_view kLetters = "\"\\/bfnrt", kMeanings = "\"\\/\b\f\n\r\t";
    if (take("u")) return append_utf8(text, code_point());
    const auto which = kLetters.find(peek());
    if (is_end() || which == std::string_view::npos) fail("unknown escape \\" + (is_end() ? "" : found()));
    text.push_back(kMeanings[which]);
    next();
  }

  std::uint32_t code_point() {
    const std::uint32_t first = hex4();
    if (first >= 0xDC00 && first < 0xE000) fail("half of a surrogate pair");
    if (first < 0xD800 || first >= 0xDC00) return first;
    if (!take("\\u")) fail("half of a surrogate pair");
    const std::uint32_t second = hex4();
    if (second < 0xDC00 || second >= 0xE000) fail("half of a surrogate pair");
    return 0x10000 + ((first - 0xD800) << 10) + (second - 0xDC00);
  }

  std::uint32_t hex4() {
    static constexpr std::string_view kDigits = "0123456789abcdef";
    std::uint32_t code = 0;
    for (int i = 0; i < 4; ++i) {
      const char c = peek();
      const auto digit = kDigits.find(c >= 'A' && c <= 'F' ? static_cast<char>(c - 'A' + 'a') : c);
      if (is_end() || digit == std::string_view::npos) fail("expected four hexadecimal digits");
      code = code * 16 + static_cast<std::uint32_t>(digit);
      next();
    }
    return code;
  }

  void number(Value& result) {
    result.kind = Value::Kind::Number;
    static constexpr std::string_view kParts = "+-.0123456789eE";
    while (!is_end() && kParts.find(peek()) != std::string_view::npos) result.text.push_back(next());
    if (!parse_json_number(result.text, result.number))
      fail_at(result.place, "\"" + result.text + "\" is not a finite number");
  }

  void word(Value& result) {
    if (take("null")) return;
    result.kind = Value::Kind::Bool;
    result.boolean = take("true");
    if (!result.boolean && !take("false")) fail("expected a value, found " + found());
  }

  std::string_view text_;
  const std::string& file_;
  std::size_t at_ = 0;
  int line_ = 1;
  int column_ = 1;
};
}  // namespace

Value parse_json_text(std::string_view text, const std::string& file) {
  return JsonParser(text, file).document();
}

}  // namespace skinforge
