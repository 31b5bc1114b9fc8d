#include "recipe/value_tree.h"

#include <fmt/core.h>

#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/text.h"

namespace skinforge {

namespace {
std::size_t digits_from(std::string_view text, std::size_t i) {
  const std::size_t begin = i;
  while (i < text.size() && text[i] >= '0' && text[i] <= '9') ++i;
  return i - begin;
}

// Length of the number at the start of `text` by RFC 8259, section 6; 0 when there is none.
std::size_t json_number_length(std::string_view text) {
  std::size_t i = text.starts_with('-') ? 1 : 0;
  const std::size_t whole = digits_from(text, i);
  if (whole == 0 || (whole > 1 && text[i] == '0')) return 0;
  i += whole;
  if (i < text.size() && text[i] == '.') {
    const std::size_t fraction = digits_from(text, i + 1);
    if (fraction == 0) return 0;
    i += 1 + fraction;
  }
  if (i < text.size() && (text[i] == 'e' || text[i] == 'E')) {
    std::size_t digits = i + 1;
    if (digits < text.size() && (text[digits] == '+' || text[digits] == '-')) ++digits;
    const std::size_t exponent = digits_from(text, digits);
    if (exponent == 0) return 0;
    i = digits + exponent;
  }
  return i;
}

// Length of the UTF-8 sequence that `text` starts with (RFC 3629); 0 when it is not one.
std::size_t utf8_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U; };
  const unsigned lead = byte(0);
  if (lead < 0x80) return 1;
  const std::size_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((byte(i) & 0xC0) != 0x80) return 0;
  const bool is_overlong = (lead == 0xE0 && byte(1) < 0xA0) || (lead == 0xF0 && byte(1) < 0x90);
  const bool is_surrogate = lead == 0xED && byte(1) >= 0xA0;
  const bool is_too_large = lead == 0xF4 && byte(1) >= 0x90;
  return is_overlong || is_surrogate || is_too_large ? 0 : length;
}
}  // namespace

void expect_recipe_text(std::string_view text, const std::string& file) {
  TextPlace place;
  if (text.size() > kMaxRecipeBytes)
    throw text_error(
        file, place,
        fmt::format("a recipe has at most {} bytes, this file has {}", kMaxRecipeBytes, text.size()));
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    if (length == 0 || text[0] == '\0') throw text_error(file, place, "this is not UTF-8 text");
    place = text[0] == '\n' ? TextPlace{place.line + 1, 1} : TextPlace{place.line, place.column + 1};
    text.remove_prefix(length);
  }
}

bool parse_json_number(std::string_view text, double& number) {
  if (text.empty() || json_number_length(text) != text.size()) return false;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() && std::isfinite(number);
}

std::string Value::describe() const {
  switch (kind) {
    case Kind::Null:
      return "null";
    case Kind::Bool:
      return boolean ? "true" : "false";
    case Kind::Number:
      return "the number " + text;
    case Kind::String:
      return fmt::format("the string \"{}\"", printable(text));
    case Kind::Array:
      return fmt::format("a list of {}", items.size());
    case Kind::Object:
      return "an object";
  }
  return {};
}

const Value* Value::find(std::string_view key) const {
  for (const Member& member : members)
    if (member.key == key) return &member.value;
  return nullptr;
}

Value* Value::find(std::string_view key) {
  return const_cast<Value*>(std::as_const(*this).find(key));
}

std::string Value::where() const {
  return origin.empty() ? fmt::format("{}:{}:{}", file_name(), place.line, place.column) : origin;
}

namespace {
// As JSON reads it back; words of a command line may be no UTF-8.
std::string quoted(const std::string& text) {
  using nlohmann::json;
  return json(text).dump(-1, ' ', false, json::error_handler_t::replace);
}
}  // namespace

std::string value_text(const Value& value) {
  const auto joined = [](const auto& items, const auto& text) {
    std::string all;
    for (const auto& item : items) all += (all.empty() ? "" : ", ") + text(item);
    return all;
  };
  switch (value.kind) {
    case Value::Kind::Null:
      return "null";
    case Value::Kind::Bool:
      return value.boolean ? "true" : "false";
    case Value::Kind::Number:
      return fmt::format("{}", value.number);
    case Value::Kind::String:
      return quoted(value.text);
    case Value::Kind::Array:
      return fmt::format("[{}]", joined(value.items, value_text));
    case Value::Kind::Object:
      return fmt::format("{{{}}}", joined(value.members, [](const Value::Member& member) {
                           return quoted(member.key) + ": " + value_text(member.value);
                         }));
  }
  return {};
}

Error text_error(const std::string& file, const TextPlace& place, const std::string& message) {
  return Error(ExitCode::Usage, fmt::format("{}:{}:{}: {}", file, place.line, place.column, message));
}

}  // namespace skinforge
