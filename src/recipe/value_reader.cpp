#include "recipe/value_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "recipe/schema_properties.h"

namespace skinforge {

std::string pointer_to(const std::string& pointer, std::string_view key) {
  std::string step = pointer + "/";
  for (const char c : key) {
    if (c == '~')
      step += "~0";
    else if (c == '/')
      step += "~1";
    else
      step.push_back(c);
  }
  return step;
}

void ValueReader::fail(const std::string& message) const {
  if (!value_->origin.empty())
    throw Error(ExitCode::Usage,
                value_->origin + ": " + (pointer_.empty() ? "" : printable(pointer_) + ": ") + message);
  throw text_error(value_->file ? *value_->file : *file_, value_->place,
                   (pointer_.empty() ? "" : printable(pointer_) + ": ") + message);
}

void ValueReader::fail_expected(const std::string& wanted) const {
  fail("expected " + wanted + ", found " + value_->describe());
}

bool ValueReader::boolean() const {
  if (value_->is_ambiguous) fail("write true or false instead of " + value_->text);
  if (value_->kind != Value::Kind::Bool) fail_expected("true or false");
  return value_->boolean;
}

std::string ValueReader::text() const {
  if (value_->is_ambiguous)
    fail(fmt::format("put \"{}\" in quotes: plain {} is true or false to some readers", value_->text,
                     value_->text));
  if (value_->kind != Value::Kind::String) fail_expected("a string");
  if (value_->text.empty()) fail("expected a string, found an empty one");
  return value_->text;
}

double ValueReader::number() const {
  if (value_->kind != Value::Kind::Number) fail_expected("a number");
  return value_->number;
}

double ValueReader::number(double least, double most) const {
  const double value = number();
  if (value < least || value > most) fail_expected(fmt::format("a number from {} to {}", least, most));
  return value;
}

int ValueReader::integer(int least, int most) const {
  const double value = number();
  if (value != std::floor(value) || value < least || value > most)
    fail_expected(fmt::format("a whole number from {} to {}", least, most));
  return static_cast<int>(value);
}

ObjectReader ValueReader::object(std::initializer_list<std::string_view> known) const {
  if (!is_object()) fail_expected("an object");
  for (const Value::Member& member : value_->members) {
    if (std::find(known.begin(), known.end(), member.key) != known.end()) continue;
    const std::vector<std::string> names(known.begin(), known.end());
    Value at_key;
    at_key.place = member.place;
    ValueReader(at_key, *file_, pointer_)
        .fail(fmt::format("unknown key \"{}\"{}", printable(member.key), nearest_hint(member.key, names)));
  }
  return ObjectReader(*this);
}

std::vector<std::pair<std::string, ValueReader>> ValueReader::members() const {
  if (!is_object()) fail_expected("an object");
  std::vector<std::pair<std::string, ValueReader>> readers;
  for (const Value::Member& member : value_->members)
    readers.emplace_back(member.key, ValueReader(member.value, *file_, pointer_to(pointer_, member.key)));
  return readers;
}

std::vector<ValueReader> ValueReader::items() const {
  if (!is_array()) fail_expected("a list");
  std::vector<ValueReader> readers;
  for (std::size_t i = 0; i < value_->items.size(); ++i)
    readers.emplace_back(value_->items[i], *file_, pointer_to(pointer_, std::to_string(i)));
  return readers;
}

std::size_t ValueReader::index_of_word(const std::vector<std::string>& names) const {
  const auto found = std::find(names.begin(), names.end(), value_->text);
  if (is_string() && found != names.end()) return static_cast<std::size_t>(found - names.begin());
  fail(fmt::format("expected one of \"{}\", found {}{}", fmt::join(names, "\", \""), value_->describe(),
                   is_string() ? nearest_hint(value_->text, names) : ""));
}

namespace {
// What the schema gives as an example of a property.
std::string example_of(const std::string& pointer, std::string_view key) {
  for (const SchemaProperty& property : schema_properties())
    if (!property.examples.empty() && matches_pattern(property.pattern, pointer))
      return fmt::format(", such as \"{}\": {}", key, property.examples.front());
  return "";
}
}  // namespace

std::optional<ValueReader> ObjectReader::find(std::string_view key) const {
  for (auto& [name, reader] : reader_.members())
    if (name == key) return reader;
  return std::nullopt;
}

ValueReader ObjectReader::at(std::string_view key) const {
  auto found = find(key);
  if (!found)
    reader_.fail(
        fmt::format("missing key \"{}\"{}", key, example_of(pointer_to(reader_.pointer(), key), key)));
  return *found;
}

}  // namespace skinforge
