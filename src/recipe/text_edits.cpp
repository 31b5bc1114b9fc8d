#include "recipe/text_edits.h"

#include <algorithm>

namespace skinforge {

namespace {
constexpr std::string_view kSpace = " \t\r";

bool is_continuation(char c) {
  return (static_cast<unsigned char>(c) & 0xC0) == 0x80;
}

// Behind the comment that begins at `at`; `at` where none does.
std::size_t skip_comment(const std::string& text, std::size_t at) {
  const auto behind = [&](std::string_view closing) {
    const std::size_t end = text.find(closing, at);
    return end == std::string::npos ? text.size() : end + closing.size();
  };
  if (text.compare(at, 2, "//") == 0) return behind("\n");
  return text.compare(at, 2, "/*") == 0 ? behind("*/") : at;
}

// The next character from `at` on that is neither space nor in a comment.
std::size_t skip_space(const std::string& text, std::size_t at) {
  for (;;) {
    at = std::min(text.find_first_not_of(" \t\r\n", at), text.size());
    const std::size_t behind = at < text.size() ? skip_comment(text, at) : at;
    if (behind == at) return at;
    at = behind;
  }
}

// Behind a quoted word, or a plain one that ends where the text of a value can.
std::size_t end_of_word(const std::string& text, std::size_t at) {
  if (at >= text.size()) return text.size();
  const char quote = text[at];
  if (quote != '"' && quote != '\'') {
    const std::size_t end = std::min(text.find_first_of(",}]:\n#", at), text.size());
    return text.find_last_not_of(kSpace, end - 1) + 1;
  }
  for (std::size_t i = at + 1; i < text.size(); ++i) {
    if (text[i] == '\\' && quote == '"')
      ++i;
    else if (text[i] == quote)
      return i + 1;
  }
  return text.size();
}

// The last character before `at` that is neither space nor in a comment.
std::size_t last_before(const std::string& text, std::size_t at) {
  std::size_t last = 0;
  for (std::size_t i = skip_space(text, 0); i < at;) {
    const std::size_t end = text[i] == '"' ? end_of_word(text, i) : i + 1;
    last = end - 1;
    i = skip_space(text, end);
  }
  return last;
}

std::size_t begin_of_line(const std::string& text, std::size_t at) {
  const std::size_t end = at == 0 ? std::string::npos : text.rfind('\n', at - 1);
  return end == std::string::npos ? 0 : end + 1;
}

bool is_blank(const std::string& text, std::size_t begin, std::size_t end) {
  return std::all_of(text.begin() + static_cast<std::ptrdiff_t>(begin),
                     text.begin() + static_cast<std::ptrdiff_t>(end),
                     [](char c) { return kSpace.find(c) != std::string_view::npos; });
}
}  // namespace

TextEdits::TextEdits(std::string text, const Value& root) : text_(std::move(text)) {
  const std::size_t at = offset_of(root.place);
  is_flow_ = at < text_.size() && text_[at] == '{';
}

// Columns count characters, and the mark of byte order is none.
std::size_t TextEdits::offset_of(const TextPlace& place) const {
  std::size_t at = text_.starts_with("\xEF\xBB\xBF") ? 3 : 0;
  for (int line = 1; line < place.line; ++line) at = std::min(text_.find('\n', at), text_.size() - 1) + 1;
  for (int column = 1; column < place.column && at < text_.size(); ++column)
    for (++at; at < text_.size() && is_continuation(text_[at]);) ++at;
  return at;
}

std::size_t TextEdits::end_of_member(std::size_t key) const {
  const std::size_t colon = skip_space(text_, end_of_word(text_, key));
  return end_of_word(text_, skip_space(text_, colon + 1));
}

void TextEdits::remove_member(const TextPlace& key) {
  std::size_t begin = offset_of(key), end = end_of_member(begin);
  const bool has_commas = text_[last_before(text_, begin)] == ',' || text_[last_before(text_, begin)] == '{';
  if (const std::size_t next = skip_space(text_, end);
      has_commas && next < text_.size() && text_[next] == ',') {
    if (next != end) edits_.push_back({next, next + 1, ""});  // behind a comment, which stays
    end = next == end ? next + 1 : end;
  } else if (const std::size_t comma = last_before(text_, begin); text_[comma] == ',') {
    edits_.push_back({comma, comma + 1, ""});  // the last of several
  }
  const std::size_t line = begin_of_line(text_, begin);
  const std::size_t line_end = std::min(text_.find('\n', end), text_.size());
  if (is_blank(text_, line, begin) && is_blank(text_, end, line_end)) {
    begin = line;
    end = std::min(line_end + 1, text_.size());
  } else {
    while (end < text_.size() && kSpace.find(text_[end]) != std::string_view::npos) ++end;
  }
  edits_.push_back({begin, end, ""});
}

void TextEdits::replace_word(const TextPlace& value, std::string_view before, std::string_view after) {
  const std::size_t at = offset_of(value);
  const std::size_t begin = text_.find(before, at);
  if (begin == std::string::npos || begin > at + 1) return;
  edits_.push_back({begin, begin + before.size(), std::string(after)});
}

void TextEdits::insert_member(const TextPlace& before, const std::string& key, const std::string& value) {
  const std::size_t at = offset_of(before), line = begin_of_line(text_, at);
  const bool has_own_line = is_blank(text_, line, at);
  const bool is_quoted = is_flow_ && text_[at] == '"';
  std::string text = is_quoted ? '"' + key + '"' : key;
  text += ": " + value + (is_flow_ ? "," : "");
  text += has_own_line ? "\n" + text_.substr(line, at - line) : " ";
  edits_.push_back({at, at, text});
}

std::string TextEdits::text() const {
  std::vector<Edit> edits = edits_;
  std::stable_sort(edits.begin(), edits.end(),
                   [](const Edit& a, const Edit& b) { return a.begin > b.begin; });
  std::string text = text_;
  for (const Edit& edit : edits) text.replace(edit.begin, edit.end - edit.begin, edit.text);
  return text;
}

}  // namespace skinforge
