#pragma once

#include <fmt/format.h>

#include <charconv>
#include <string>
#include <string_view>

#include "base/error.h"
#include "base/text.h"

namespace skinforge {

/// Walks through a text of lines of words, and knows the line for messages. `comment` starts a comment that
/// lasts to the end of its line; 0 = there are none.
class LineReader {
 public:
  explicit LineReader(std::string_view text, char comment = 0) : text_(text), comment_(comment) {}

  /// Throws Error (BadInput) "line 8: <sentence>".
  [[noreturn]] void fail(const std::string& sentence) const {
    throw Error(ExitCode::BadInput, fmt::format("line {}: {}", line_number_, sentence));
  }

  /// Goes to the next line that holds something; false at the end of the text.
  bool find_line() {
    do {
      if (at_ >= text_.size()) return false;
      const auto end = std::min(text_.find('\n', at_), text_.size());
      line_ = text_.substr(at_, end - at_);
      if (comment_) line_ = line_.substr(0, line_.find(comment_));
      at_ = end + 1;
      ++line_number_;
    } while (!has_more());
    return true;
  }

  /// The same where a line must follow.
  void next_line() {
    if (!find_line()) fail("the file ends too early");
  }

  /// Whether the line has a word left.
  bool has_more() const { return line_.find_first_not_of(kBlank) != std::string_view::npos; }

  /// Next word of the line; empty at its end.
  std::string_view next_word() {
    const auto begin = std::min(line_.find_first_not_of(kBlank), line_.size());
    const auto end = std::min(line_.find_first_of(kBlank, begin), line_.size());
    const std::string_view word = line_.substr(begin, end - begin);
    line_.remove_prefix(end);
    return word;
  }

  /// The next word as a number; `what` names it when it is missing or something else.
  template <class Number>
  Number read(const char* what) {
    return number<Number>(next_word(), what);
  }

  template <class Number>
  Number number(std::string_view word, const char* what) const {
    Number value{};
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (word.empty() || error != std::errc() || end != word.data() + word.size())
      fail(fmt::format("{} is missing, found \"{}\"", what, printable(word.substr(0, 40))));
    return value;
  }

  /// The bytes behind the current line.
  std::string_view rest() const { return text_.substr(std::min(at_, text_.size())); }

 private:
  static constexpr std::string_view kBlank = " \t\r\f\v";
  std::string_view text_, line_;
  std::size_t at_ = 0, line_number_ = 0;
  char comment_;
};

}  // namespace skinforge
